#include "dense.hpp"

namespace ifsi::test {

Eigen::VectorXd gather(const Layout& layout, int block, const double* x) {
  const std::vector<double> all =
      layout.communicator().all_gather(std::vector<double>(x, x + layout.n_owned() * block));
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<long>(all.size()));
}

std::vector<double> scatter(const Layout& layout, int block, const Eigen::VectorXd& all) {
  std::vector<double> x(static_cast<std::size_t>(layout.n_local()) * block, 0.0);
  for (int i = 0; i < layout.n_owned() * block; ++i) x[i] = all[layout.first_global() * block + i];
  return x;
}

Eigen::MatrixXd dense(long n, const std::vector<DenseEntry>& entries) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (const DenseEntry& e : entries) A(e.row, e.col) = e.value;
  return A;
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& A) { return A.inverse(); }
Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A * B; }
Eigen::VectorXd multiply(const Eigen::MatrixXd& A, const Eigen::VectorXd& x) { return A * x; }
Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.partialPivLu().solve(b);
}

Eigen::VectorXd some_vector(long n, double seed) {
  Eigen::VectorXd x(n);
  for (long i = 0; i < n; ++i) x[i] = std::sin(seed + 1.7 * static_cast<double>(i)) + 0.2;
  return x;
}

}  // namespace ifsi::test
