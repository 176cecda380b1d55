// <bsdf>: what reflects, what lets light through, and what stands around them: `twosided`, `mask`, `blendbsdf`, `normalmap`,
// `bumpmap`.
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

    // Each element is stored once, however many shapes it stands on. In place of one that is wrong stands the default.
    Materials::Sides sides(const Element& e);
    // What stands on a shape that names no material: Mitsuba's diffuse of reflectance 0.5, or nothing where it emits.
    Materials::Sides default_sides(bool emits);

    bool has(const Element& e) const { return sides_.count(&e) > 0; }
    std::vector<Bsdf> take() { return std::move(bsdfs_); }

private:
    int store(Bsdf bsdf);
    Materials::Sides read(const Element& e);
    Materials::Sides read_perturbed_normal(const Element& e);
    Materials::Sides read_two_sided(const Element& e);
    Materials::Sides read_mask(const Element& e);
    Materials::Sides read_blend(const Element& e);
    std::shared_ptr<const Bsdf> shared(int index) const;

    const Context& context_;
    std::vector<Bsdf> bsdfs_;
    std::map<const Element*, Materials::Sides> sides_;
    std::set<const Element*> open_;  // being read
    int default_ = Materials::absorbing;
};

}  // namespace neumann::reader
