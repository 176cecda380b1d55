// One colour channel of a traced K = R T, for the solvers: K is applied as R(T x), and asked for rows and columns by the table.
#pragma once

#include "operators/matrix/adjoint.h"
#include "operators/solvers/channel_operator.h"

#include <Eigen/SparseCore>

namespace neumann {

class TracedChannel : public ChannelOperator {
public:
    // The table and R are kept by reference.
    TracedChannel(const RayTable& table, const ReflectionMatrix<1>& R);

    Eigen::Index size() const override { return measure_.size(); }
    void apply(const Vector& x, Vector& y) const override;
    void apply_adjoint(const Vector& x, Vector& y) const override;
    double row(Eigen::Index u, const Vector& x) const override;
    double diagonal(Eigen::Index u) const override;
    void add_column(Eigen::Index u, double a, Vector& y) const override;
    const Vector& measure() const override { return measure_; }

    // Of (K* 1)_u, the part of u's power that is left after a bounce, which as many rays tell as happen to meet u.
    double standard_error_of_power(Eigen::Index u) const;

    // ρ of each unknown with K = diag(ρ) F; empty where a side is not diffuse.
    const Vector& reflectance() const { return reflectance_; }

private:
    double mean(std::uint32_t arriving, const Vector& x) const;

    const RayTable* table_;
    const ReflectionMatrix<1>* R_;
    Vector reflectance_, measure_;
    Seers seers_;
    std::vector<std::uint32_t> facet_of_unknown_, arrives_in_;  // an unknown, for each ray
};

// T and R as matrices, for whoever wants to hold them: rows of T are rays, R has a row an unknown and a column a ray; K = R T.
Eigen::SparseMatrix<double, Eigen::RowMajor> transport_matrix(const RayTable& table);
Eigen::SparseMatrix<double, Eigen::RowMajor> reflection_matrix(const RayTable& table, const ReflectionMatrix<1>& R);
// Entries of it.
std::size_t reflection_entries(const RayTable& table, const ReflectionMatrix<1>& R);

}  // namespace neumann
