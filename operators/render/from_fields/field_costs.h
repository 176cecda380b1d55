// Predicts the seconds and bytes of the next render from fields, fitted to the renders before it.
#pragma once

#include "operators/render/from_fields/field_pictures.h"

#include <vector>

namespace neumann {

struct FieldCost {
    double seconds = 0.0, bytes = 0.0;
};

class FieldCosts {
public:
    // Keeps a reference to the film.
    explicit FieldCosts(const Film& film) : film_(&film) {}

    // Learns from a render with these settings that took `seconds` altogether.
    void add(const FieldSettings& settings, const FieldPictures& pictures, double seconds);
    // The time of the fields is linear in the rays of T, that of the pictures in the samples, each with a constant
    // part. The bytes include the previous pictures, which are kept meanwhile.
    FieldCost predict(const FieldSettings& settings) const;

private:
    struct Line {
        double work = 0.0, seconds = 0.0, slope = 0.0;
        void add(double more_work, double took);
        double at(double w) const { return seconds + slope * (w - work); }
    };
    double table(const FieldSettings& settings) const;
    double scale(const FieldSettings& settings) const;

    const Film* film_;
    std::map<std::uint32_t, std::size_t> sides_;
    // Numbers of the last render; `requested_`: the patches in its settings.
    std::size_t patches_ = 0, requested_ = 0, unknowns_ = 0;
    bool has_links_ = false;
    Line fields_, pictures_;
    double other_ = 0.0;
};

}  // namespace neumann
