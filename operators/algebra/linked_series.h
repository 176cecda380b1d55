// The series of linked operators, L = Le + Σ_m R T_m L, where an operator stands for several bounces at once.
//
// A ray that is reflected by m mirrors on its way brings light of m more bounces: with K = Σ_m R T_m, where T_m adds m
// to the number of bounces, the terms are f_{k+1} = R Σ_m T_m f_{k−m}. Without links (m = 0 only) it is the Neumann
// series. A source term b_k may be added to bounce k.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace neumann {

// `product(field)` is R Σ_m T_m field(m), where field(m) points to a field, or is null for 0. If the product works on finer fields
// than those of the terms, `lift` makes a finer field of a term, and `lower` makes a term of a finer field.
template <class Field, class Product, class Lift, class Lower>
class LinkedSeries {
public:
    // `first` is the first term, and `links` the largest m.
    LinkedSeries(const Product& product, Lift lift, Lower lower, int links, Field first)
        : product_(product),
          lift_(std::move(lift)),
          lower_(std::move(lower)),
          links_(static_cast<std::size_t>(links)),
          term_(std::move(first)) {
        keep();
    }

    const Field& term() const { return term_; }

    // Steps to f_{k+1} = R Σ_m T_m f_{k−m} + b_{k+1}. `source` is b_{k+1}, or null for 0.
    void advance(const Field* source) {
        term_ = plus(lower_(product_([&](int m) { return past(static_cast<std::size_t>(m)); })), source);
        keep();
    }

    // K f, where all links see the same f.
    Field apply(const Field& f) const {
        const Field lifted = lift_(f);
        return lower_(product_([&](int) { return &lifted; }));
    }

    bool has_links() const { return links_ > 0; }
    // R Σ_m T_m Σ_{j≤m} f_{k−j} + b. The sum S of all later terms solves S = K S + this.
    Field rest_source(const Field* source) const {
        std::vector<Field> sums{past_.front()};
        for (std::size_t j = 1; j < past_.size(); ++j) sums.push_back(sums.back() + past_[j]);
        return plus(lower_(product_([&](int m) { return &sums[std::min(static_cast<std::size_t>(m), sums.size() - 1)]; })), source);
    }

private:
    static Field plus(Field f, const Field* source) {
        if (source) f = std::move(f) + *source;
        return f;
    }
    void keep() {
        past_.push_front(lift_(term_));
        if (past_.size() > links_ + 1) past_.pop_back();
    }
    const Field* past(std::size_t m) const { return m < past_.size() ? &past_[m] : nullptr; }

    const Product& product_;
    Lift lift_;
    Lower lower_;
    std::size_t links_;
    Field term_;
    std::deque<Field> past_;  // f_k, f_{k−1}, … after `lift`
};

}  // namespace neumann
