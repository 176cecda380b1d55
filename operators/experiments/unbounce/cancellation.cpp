#include "operators/experiments/unbounce/cancellation.h"

namespace neumann {

Eigen::MatrixXd direct_light(const Eigen::MatrixXd& T, const Eigen::MatrixXd& inverse) {
    Eigen::MatrixXd direct = Eigen::MatrixXd::Zero(T.rows(), T.cols());
    for (Eigen::Index r = 0; r < T.rows(); ++r) direct(r, r) = T.row(r).dot(inverse.col(r)) / inverse(r, r);
    return direct;
}

UnbouncedRegions unbounce(const Cancellation& operators, const Eigen::VectorXd& picture, int bounces) {
    const Eigen::MatrixXd indirect = operators.T - operators.direct;
    UnbouncedRegions result;
    Eigen::VectorXd term = picture;
    for (int n = 1; n <= bounces; ++n) {
        result.weights.emplace_back(operators.inverse * term);
        term = (n == 1 ? operators.direct : indirect) * result.weights.back();
        result.terms.push_back(term);
    }
    return result;
}

}  // namespace neumann
