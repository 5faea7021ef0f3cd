#pragma once
/// \file
/// The material tangent dP/dF and the few fourth-order products that laws are written in.

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// dP/dF as a square matrix: entry (i n + J, k n + L) is dP_iJ / dF_kL. Small letters are current, capital
/// letters reference directions.
template <class T, int n>
using Tangent = Mat<T, n * n>;

/// A_iJkL = entry(i, J, k, L).
template <class T, int n, class Entry>
constexpr Tangent<T, n> tangent_from(const Entry& entry) {
  Tangent<T, n> A;
  for (int i = 0; i < n; ++i)
    for (int J = 0; J < n; ++J)
      for (int k = 0; k < n; ++k)
        for (int L = 0; L < n; ++L) A(i * n + J, k * n + L) = entry(i, J, k, L);
  return A;
}

/// A_iJkL += s delta_ik delta_JL.
template <class T, int n2>
constexpr void add_identity(Mat<T, n2>& A, const T& s) {
  for (int a = 0; a < n2; ++a) A(a, a) += s;
}

/// A_iJkL += delta_ik S_JL: what a second Piola-Kirchhoff stress S does to P = F S.
template <class T, int n>
constexpr void add_geometric(Tangent<T, n>& A, const Mat<T, n>& S) {
  for (int i = 0; i < n; ++i)
    for (int J = 0; J < n; ++J)
      for (int L = 0; L < n; ++L) A(i * n + J, i * n + L) += S(J, L);
}

/// A_iJkL += B_ik delta_JL.
template <class T, int n>
constexpr void add_spatial(Tangent<T, n>& A, const Mat<T, n>& B) {
  for (int J = 0; J < n; ++J)
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) A(i * n + J, k * n + J) += B(i, k);
}

/// (A : B)_iJ = A_iJkL B_kL.
template <class T, int n>
constexpr Mat<T, n> contract(const Tangent<T, n>& A, const Mat<T, n>& B) {
  Mat<T, n> r;
  for (int a = 0; a < n * n; ++a) {
    r.data[a] = A(a, 0) * B.data[0];
    for (int b = 1; b < n * n; ++b) r.data[a] += A(a, b) * B.data[b];
  }
  return r;
}

}  // namespace ifsi
