#include "ifsi/linalg/gauss_seidel.hpp"

#include <numbers>

namespace ifsi {

namespace {

/// Leja's order: each number as far as possible from those before, by the product of distances. In any plain
/// order the products of 1 - w_k lambda, and rounding errors with them, grow like the powers of the largest
/// weights before the small ones bring them down, or after.
std::vector<double> leja_order(std::vector<double> zeros) {
  for (std::size_t k = 1; k < zeros.size(); ++k) {
    const auto distance = [&](double candidate) {
      double product = 1;
      for (std::size_t j = 0; j < k; ++j) product *= std::abs(candidate - zeros[j]);
      return product;
    };
    const auto best = std::max_element(zeros.begin() + k, zeros.end(),
                                       [&](double a, double b) { return distance(a) < distance(b); });
    std::swap(zeros[k], *best);
  }
  return zeros;
}

}  // namespace

std::vector<float> chebyshev_weights(double lowest, double error) {
  const double reach = std::acosh((1 + lowest) / (1 - lowest));
  const int n = std::max(1, static_cast<int>(std::ceil(std::acosh(1 / error) / reach)));
  std::vector<double> zeros(n);
  for (int k = 0; k < n; ++k)
    zeros[k] = (1 + lowest) / 2 + (1 - lowest) / 2 * std::cos(std::numbers::pi * (k + 0.5) / n);
  std::vector<float> weights;
  for (double zero : leja_order(std::move(zeros))) weights.push_back(static_cast<float>(1 / zero));
  return weights;
}

template <int D>
void GaussSeidel<D>::scale() {
  const OverlapPattern& at = A_.pattern();
  inverse_.resize(static_cast<std::size_t>(A_.n_rows()) * D * D);
  for (int i = 0; i < A_.n_rows(); ++i) {
    float* diagonal = &inverse_[static_cast<std::size_t>(i) * D * D];
    std::copy_n(A_.at(at.diagonal[i]), D * D, diagonal);
    invert<D>(diagonal, i);
    for (int k = at.row_ptr[i]; k < at.row_ptr[i + 1]; ++k) multiply_from_left<D>(diagonal, A_.at(k));
  }
  lower_.take_lower(A_);
  upper_.take_upper(A_);
  swept_.resize(static_cast<std::size_t>(A_.n_rows()) * D);
  above_.resize(swept_.size());
}

/// With all rows divided by their diagonal blocks a pass from x is
///
///     y = b - U x - L y  forward,    z = b - L y - U z = (U x + y) - U z  backward,    x <- x + w (z - x).
///
/// Where U x is kept, each sweep reads its half of the matrix alone, and b - A x is never formed (Conrad and
/// Wallach 1979).
template <int D>
void GaussSeidel<D>::apply(float* b, float* x) {
  A_.layout().update_ghosts(b, D);
  first_pass(b, x);
  for (std::size_t pass = 1; pass < weights_.size(); ++pass) next_pass(b, x, weights_[pass]);
}

/// From x = 0; divides b by the diagonal blocks.
template <int D>
void GaussSeidel<D>::first_pass(float* b, float* x) {
  typename Triangle<D, Bfloat16>::Reader rows_of_L(lower_), rows_of_U(upper_);
  float* y = swept_.data();
  float scaled[D];
  for (int i = 0; i < A_.n_rows(); ++i) {
    const std::size_t at = static_cast<std::size_t>(i) * D;
    multiply<D>(&inverse_[at * D], b + at, scaled);
    std::copy_n(scaled, D, b + at);
    rows_of_L.next_residual(scaled, y, y + at);
  }
  for (int i = A_.n_rows() - 1; i >= 0; --i) {
    const std::size_t at = static_cast<std::size_t>(i) * D;
    float before[D];
    std::copy_n(y + at, D, before);
    rows_of_U.next_residual(before, y, y + at);
    for (int c = 0; c < D; ++c) {
      x[at + c] = weights_[0] * y[at + c];
      above_[at + c] = weights_[0] * (before[c] - y[at + c]);
    }
  }
}

template <int D>
void GaussSeidel<D>::next_pass(const float* b, float* x, float weight) {
  typename Triangle<D, Bfloat16>::Reader rows_of_L(lower_), rows_of_U(upper_);
  float *y = swept_.data(), *above = above_.data();
  float rest[D];
  for (int i = 0; i < A_.n_rows(); ++i) {
    const std::size_t at = static_cast<std::size_t>(i) * D;
    for (int c = 0; c < D; ++c) rest[c] = b[at + c] - above[at + c];
    rows_of_L.next_residual(rest, y, y + at);
  }
  for (int i = A_.n_rows() - 1; i >= 0; --i) {
    const std::size_t at = static_cast<std::size_t>(i) * D;
    for (int c = 0; c < D; ++c) rest[c] = above[at + c] + y[at + c];
    rows_of_U.next_residual(rest, y, y + at);
    for (int c = 0; c < D; ++c) {
      x[at + c] += weight * (y[at + c] - x[at + c]);
      above[at + c] += weight * (rest[c] - y[at + c] - above[at + c]);
    }
  }
}

template class GaussSeidel<2>;
template class GaussSeidel<3>;

}  // namespace ifsi
