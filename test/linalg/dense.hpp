#pragma once
// The dense oracle: a distributed matrix or vector gathered on every rank. What Eigen is slow to compile is
// in dense.cpp.
#include "ifsi/linalg/block_csr.hpp"
#include "support/eigen.hpp"

namespace ifsi::test {

/// Owned part of a distributed vector -> the whole vector.
Eigen::VectorXd gather(const Layout& layout, int block, const double* x);

/// Local part (ghost room included, ghosts zero) of a whole vector.
std::vector<double> scatter(const Layout& layout, int block, const Eigen::VectorXd& all);

struct DenseEntry {
  long row, col;
  double value;
};
Eigen::MatrixXd dense(long n, const std::vector<DenseEntry>& entries);

template <int B>
Eigen::MatrixXd dense(const BlockCsr<B>& K) {
  std::vector<DenseEntry> mine;
  for (int i = 0; i < K.n_rows(); ++i)
    for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k)
      for (int r = 0; r < B; ++r)
        for (int c = 0; c < B; ++c)
          mine.push_back(
              {K.layout().global(i) * B + r, K.layout().global(K.cols()[k]) * B + c, K.at(k)[r * B + c]});
  return dense(K.layout().n_global() * B, K.layout().communicator().all_gather(mine));
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);
Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
Eigen::VectorXd multiply(const Eigen::MatrixXd& A, const Eigen::VectorXd& x);
/// A^-1 b
Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Reproducible numbers of mixed sign that depend on the global index only.
Eigen::VectorXd some_vector(long n, double seed = 1);

}  // namespace ifsi::test
