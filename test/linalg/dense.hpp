#pragma once
// The dense oracle: a distributed matrix or vector gathered on every rank.
#include <Eigen/Dense>

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi::test {

/// Owned part of a distributed vector -> the whole vector.
inline Eigen::VectorXd gather(const Layout& layout, int block, const double* x) {
  const std::vector<double> all =
      layout.communicator().all_gather(std::vector<double>(x, x + layout.n_owned() * block));
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<long>(all.size()));
}

/// Local part (ghost room included, ghosts zero) of a whole vector.
inline std::vector<double> scatter(const Layout& layout, int block, const Eigen::VectorXd& all) {
  std::vector<double> x(static_cast<std::size_t>(layout.n_local()) * block, 0.0);
  for (int i = 0; i < layout.n_owned() * block; ++i) x[i] = all[layout.first_global() * block + i];
  return x;
}

template <int B>
Eigen::MatrixXd dense(const BlockCsr<B>& K) {
  struct Entry {
    long row, col;
    double value;
  };
  std::vector<Entry> mine;
  for (int i = 0; i < K.n_rows(); ++i)
    for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k)
      for (int r = 0; r < B; ++r)
        for (int c = 0; c < B; ++c)
          mine.push_back(
              {K.layout().global(i) * B + r, K.layout().global(K.cols()[k]) * B + c, K.at(k)[r * B + c]});
  const long n = K.layout().n_global() * B;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (const Entry& e : K.layout().communicator().all_gather(mine)) A(e.row, e.col) = e.value;
  return A;
}

/// Reproducible numbers of mixed sign that depend on the global index only.
inline Eigen::VectorXd some_vector(long n, double seed = 1) {
  Eigen::VectorXd x(n);
  for (long i = 0; i < n; ++i) x[i] = std::sin(seed + 1.7 * static_cast<double>(i)) + 0.2;
  return x;
}

}  // namespace ifsi::test
