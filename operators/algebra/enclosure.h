// A rigorous enclosure of the whole series from three of its terms (Collatz and Wielandt's quotients).
//
// For K ≥ 0 and Le ≥ 0: if c1 t_n ≤ t_{n+p} ≤ c2 t_n at every unknown and c2 < 1, then the same holds for all later terms, and
//
//     S_{n+p} + r c1/(1−c1) ≤ L ≤ S_{n+p} + r c2/(1−c2),   r = t_{n+1} + … + t_{n+p}.
//
// p = 1 compares neighbours; p = 2 is for terms that alternate. Rounding is not enclosed.
// L. Collatz, Einschließungssatz für die charakteristischen Zahlen von Matrizen, Math. Z. 48 (1942).
#pragma once

#include "operators/algebra/agreement.h"

#include <string>

namespace neumann {

struct Enclosure {
    bool exists = false;
    std::string why;  // the reason, if there is no enclosure
    double c1 = 0.0, c2 = 0.0;
    Vector low, high;    // W·m⁻²·sr⁻¹
    double width = 0.0;  // max (high − low) / max high
};

// Needs term = t_n ≥ 0 and later = t_{n+p}, with t_n > 0 wherever t_{n+p} > 0.
Enclosure enclose(const Vector& term, const Vector& later, const Vector& sum, const Vector& rest,
                  const Agreement& agreement = Agreement::alone());

}  // namespace neumann
