// One colour channel of a traced K = R T, for the solvers: K is applied as R(T x), and asked for rows and columns by the table.
#pragma once

#include "operators/matrix/adjoint.h"
#include "operators/solvers/channel_operator.h"

#include <Eigen/SparseCore>

namespace neumann {

class TracedChannel : public ChannelOperator {
public:
    // `channel`: of R, 0 … 2. The table is kept by reference.
    template <int C>
    TracedChannel(const RayTable& table, const ReflectionMatrix<C>& R, int channel)
        : TracedChannel(table, Vector(R.albedo().row(C == 1 ? 0 : channel).transpose().matrix())) {}
    // `albedo`: of each facet.
    TracedChannel(const RayTable& table, Vector albedo);

    Eigen::Index size() const override { return measure_.size(); }
    void apply(const Vector& x, Vector& y) const override;
    void apply_adjoint(const Vector& x, Vector& y) const override;
    double row(Eigen::Index u, const Vector& x) const override;
    double diagonal(Eigen::Index u) const override;
    void add_column(Eigen::Index u, double a, Vector& y) const override;
    const Vector& measure() const override { return measure_; }

    const Vector& albedo() const { return albedo_; }

private:
    const RayTable* table_;
    Vector albedo_, measure_;
    Seers seers_;
    std::vector<std::uint32_t> facet_of_ray_;
};

// T and R as matrices, for whoever wants to hold them: rows of T are rays, R has a row an unknown and a column a ray; K = R T.
Eigen::SparseMatrix<double, Eigen::RowMajor> transport_matrix(const RayTable& table);
Eigen::SparseMatrix<double, Eigen::RowMajor> reflection_matrix(const RayTable& table, const Vector& albedo);

}  // namespace neumann
