// Matrices as text in the Matrix Market format, which SciPy, Julia and Matlab read. R. F. Boisvert, R. Pozo, K. A. Remington, The
// Matrix Market Exchange Formats: Initial Design, NISTIR 5935, 1996. Numbers have 17 digits, so reading them gives the same bits.
#pragma once

#include <Eigen/SparseCore>

#include <string>

namespace neumann {

// `comment`: one line.
std::string matrix_market(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix, const std::string& comment);
// A dense matrix, column by column.
std::string matrix_market(const Eigen::MatrixXd& matrix, const std::string& comment);

}  // namespace neumann
