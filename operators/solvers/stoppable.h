// A K that can interrupt a solver: asks a Watch before a use whether to stop.
#pragma once

#include "operators/algebra/channel_operator.h"
#include "operators/watch.h"

#include <memory>

namespace neumann {

// apply(), apply_adjoint(), row() and add_column() throw Stopped once watch.stop() returns true on one of the processes
// that share K.
class StoppableChannel : public ChannelOperator {
public:
    StoppableChannel(std::shared_ptr<const ChannelOperator> K, Watch watch) : K_(std::move(K)), watch_(std::move(watch)) {}
    // K is kept by reference.
    StoppableChannel(const ChannelOperator& K, Watch watch)
        : StoppableChannel(std::shared_ptr<const ChannelOperator>(std::shared_ptr<void>(), &K), std::move(watch)) {}

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
    void for_row(Eigen::Index u, const Entry& each) const override { K_->for_row(u, each); }
    const Vector& measure() const override { return K_->measure(); }
    const Agreement& agreement() const override { return K_->agreement(); }
    std::size_t first() const override { return K_->first(); }
    std::size_t unknowns() const override { return K_->unknowns(); }

private:
    void go_on() const {
        if (K_->agreement().any(watch_.stop())) throw Stopped();
    }
    std::shared_ptr<const ChannelOperator> K_;
    Watch watch_;
};

}  // namespace neumann
