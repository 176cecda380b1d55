// What renders from fields take, learnt from render to render: seconds that the next one will take, and bytes.
#pragma once

#include "operators/pictures/field_pictures.h"

#include <vector>

namespace neumann {

struct FieldCost {
    double seconds = 0.0, bytes = 0.0;
};

class FieldCosts {
public:
    // The film is kept by reference.
    explicit FieldCosts(const Film& film) : film_(&film) {}

    // A render with these settings, and the seconds that it took with all that was asked of it.
    void add(const FieldSettings& settings, const FieldPictures& pictures, double seconds);
    // Fields take time like rays of T, pictures like samples, and both some that does not grow. The pictures before are kept
    // meanwhile.
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
    std::size_t patches_ = 0, asked_ = 0, unknowns_ = 0;  // of the last render, and for how many patches it was asked
    Line fields_, pictures_;
    double other_ = 0.0;
};

}  // namespace neumann
