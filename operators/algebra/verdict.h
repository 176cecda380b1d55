// How a series or a solver ended. Only the first verdict means that the result has converged.
#pragma once

namespace neumann {

enum class Verdict {
    converged,   // the estimated error is below the tolerance
    rounding,    // rounding prevents a smaller error, and it is above the tolerance
    limit,       // the applications allowed were used up first
    diverging,   // the terms do not get smaller, and the spectral radius is 1 or more: there is no L
    broke_down,  // a division by zero, or numbers that are not finite: the method has no answer
    refused      // there is an answer, but it cannot be relied on; `why` gives the reason
};

inline const char* name(Verdict verdict) {
    switch (verdict) {
        case Verdict::converged:
            return "converged";
        case Verdict::rounding:
            return "rounding";
        case Verdict::limit:
            return "limit";
        case Verdict::diverging:
            return "diverging";
        case Verdict::broke_down:
            return "broke down";
        case Verdict::refused:
            return "refused";
    }
    return "";
}

}  // namespace neumann
