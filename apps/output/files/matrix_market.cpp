#include "apps/output/files/matrix_market.h"

#include <fmt/format.h>
#include <iterator>

namespace neumann {

namespace {

std::string head(const char* format, const std::string& comment) {
    return fmt::format("%%MatrixMarket matrix {} real general\n% {}\n", format, comment);
}

}  // namespace

std::string matrix_market(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix, const std::string& comment) {
    std::string text = head("coordinate", comment);
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{} {} {}\n", matrix.rows(), matrix.cols(), matrix.nonZeros());
    for (Eigen::Index row = 0; row < matrix.rows(); ++row)
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(matrix, row); entry; ++entry)
            fmt::format_to(out, "{} {} {:.17g}\n", entry.row() + 1, entry.col() + 1, entry.value());
    return text;
}

std::string matrix_market(const Eigen::MatrixXd& matrix, const std::string& comment) {
    std::string text = head("array", comment);
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{} {}\n", matrix.rows(), matrix.cols());
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
        for (Eigen::Index row = 0; row < matrix.rows(); ++row) fmt::format_to(out, "{:.17g}\n", matrix(row, column));
    return text;
}

}  // namespace neumann
