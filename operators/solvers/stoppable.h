// A K that can interrupt a solver: it checks before every use whether to go on.
#pragma once

#include "core/base/error.h"
#include "operators/solvers/channel_operator.h"

#include <functional>
#include <memory>

namespace neumann {

class Stopped : public RunError {
public:
    Stopped() : RunError("interrupted") {}
};

// Every use throws Stopped once `stop` returns true.
class StoppableChannel : public ChannelOperator {
public:
    StoppableChannel(std::shared_ptr<const ChannelOperator> K, std::function<bool()> stop)
        : K_(std::move(K)), stop_(std::move(stop)) {}
    // K is kept by reference.
    StoppableChannel(const ChannelOperator& K, std::function<bool()> stop)
        : StoppableChannel(std::shared_ptr<const ChannelOperator>(std::shared_ptr<void>(), &K), std::move(stop)) {}

    Eigen::Index size() const override { return K_->size(); }
    bool has_adjoint() const override { return K_->has_adjoint(); }
    bool has_entries() const override { return K_->has_entries(); }
    void apply(const Vector& x, Vector& y) const override {
        go_on();
        K_->apply(x, y);
    }
    void apply_adjoint(const Vector& x, Vector& y) const override {
        go_on();
        K_->apply_adjoint(x, y);
    }
    double row(Eigen::Index u, const Vector& x) const override {
        go_on();
        return K_->row(u, x);
    }
    double diagonal(Eigen::Index u) const override { return K_->diagonal(u); }
    void add_column(Eigen::Index u, double a, Vector& y) const override {
        go_on();
        K_->add_column(u, a, y);
    }
    const Vector& measure() const override { return K_->measure(); }

private:
    void go_on() const {
        if (stop_()) throw Stopped();
    }
    std::shared_ptr<const ChannelOperator> K_;
    std::function<bool()> stop_;
};

}  // namespace neumann
