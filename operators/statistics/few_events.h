// What few events leave open. A mean that is made of events — a chain comes by, a path finds a small lamp — of which only some have
// been met is more often too small than too large, and its spread is too small with it: mean ± t · standard error does not hold.
#pragma once

namespace neumann {

// How far the expectation of a non-negative quantity may lie above its `mean`, with 97.5% confidence: the gamma interval of Fay and
// Feuer (Statistics in Medicine 16, 1997), as if one more event of this `weight` had been met. `variance`: of the mean. Events
// alike have a weight of variance / mean, and then this is the exact interval of Poisson's distribution. 0 if weight is 0.
double expectation_above(double mean, double variance, double weight);

// Means with their variances, that are made of events of about the same weight.
struct Events {
    double mean = 0.0, variance = 0.0;
    void add(double m, double v) { mean += m, variance += v; }
    double weight() const { return mean > 0.0 ? variance / mean : 0.0; }
    // With one more event of this weight, which decides where few were met.
    Events and_one_of(double w) const { return {mean + w, variance + w * w}; }
};

}  // namespace neumann
