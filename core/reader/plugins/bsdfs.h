// Reads <bsdf>: reflecting and transmitting materials, and the wrappers `twosided`, `mask`, `blendbsdf`, `mixturebsdf`,
// `coating`, `normalmap`, `bumpmap`.
#pragma once

#include "core/material/materials.h"
#include "core/reader/plugins/context.h"

#include <map>
#include <memory>
#include <set>

namespace neumann::reader {

class Bsdfs {
public:
    explicit Bsdfs(const Context& context) : context_(context) {}

    // Stores each element once, however many shapes use it. A material with an error is replaced by the default.
    Materials::Sides sides(const Element& e);
    // The material of a shape that names none: Mitsuba's `diffuse` of reflectance 0.5, or none if the shape emits.
    Materials::Sides default_sides(bool emits);

    bool has(const Element& e) const { return sides_.count(&e) > 0; }
    std::vector<Bsdf> take() { return std::move(bsdfs_); }

private:
    // `parts`: the number of materials of which it is a mixture.
    int store(Bsdf bsdf, double parts = 1.0);
    double parts_of(int index) const;
    Materials::Sides read(const Element& e);
    Materials::Sides read_perturbed_normal(const Element& e);
    Materials::Sides read_two_sided(const Element& e);
    Materials::Sides read_mask(const Element& e);
    Materials::Sides read_blend(const Element& e);
    Materials::Sides read_mixture(const Element& e);
    Materials::Sides read_coating(const Element& e);
    // Stores a mixture of two materials of one side, each of which may absorb. Throws InputError if it has too many
    // parts: all of them are evaluated wherever a ray hits it.
    int store_blend(const Element& e, int first, int second, const SurfaceFunction& weight);
    // Throws InputError if a material that wraps others must not let light through.
    void refuse_transmission(const Element& nested, int index, const std::string& outer) const;
    std::shared_ptr<const Bsdf> shared(int index) const;

    const Context& context_;
    std::vector<Bsdf> bsdfs_;
    std::vector<double> parts_;  // of each bsdf
    std::map<const Element*, Materials::Sides> sides_;
    std::set<const Element*> open_;  // elements being read, to detect cycles
    int default_ = Materials::absorbing;
};

}  // namespace neumann::reader
