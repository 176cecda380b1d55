// Bounds for means of few events. If a mean is made of events, such as a path that finds a small lamp, and only some have been met,
// it is more often too small than too large, and its spread is too small with it: mean ± t · standard error does not hold.
#pragma once

namespace neumann {

// The bound, with 97.5% confidence, on how far the expectation of a non-negative quantity lies above its `mean`, whose
// variance is `variance`: the gamma interval of Fay and Feuer (Statistics in Medicine 16, 1997), as if one more event
// of this `weight` had been met. If all events are alike, their weight is variance / mean, and this is the exact
// interval of Poisson's distribution. 0 if the weight is 0.
double expectation_above(double mean, double variance, double weight);

// A sum of means with their variances that are made of events of about the same weight.
struct Events {
    double mean = 0.0, variance = 0.0;
    void add(double m, double v) { mean += m, variance += v; }
    double weight() const { return mean > 0.0 ? variance / mean : 0.0; }
    // The sum with one more event of weight w, which makes a difference if few were met.
    Events and_one_of(double w) const { return {mean + w, variance + w * w}; }
};

}  // namespace neumann
