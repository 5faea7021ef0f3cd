#pragma once
/// \file
/// Small vectors and second-order tensors over any number type (double, a SIMD pack, an automatic
/// differentiation scalar). Kernels are written once on these; nothing here allocates.

/// Unrolls the loop that follows before the compiler decides what lives in registers: without it small arrays
/// of packs stay in memory.
#define IFSI_UNROLL _Pragma("GCC unroll 16")

namespace ifsi {

/// Vector of n numbers of type T.
template <class T, int n>
struct Vec {
  T data[n];

  constexpr T& operator[](int i) { return data[i]; }
  constexpr const T& operator[](int i) const { return data[i]; }
  static constexpr int size() { return n; }
  static constexpr Vec zero() {
    Vec r;
    IFSI_UNROLL
    for (int i = 0; i < n; ++i) r[i] = T(0.0);
    return r;
  }
  constexpr bool operator==(const Vec&) const = default;
  constexpr Vec& operator+=(const Vec& b) {
    IFSI_UNROLL
    for (int i = 0; i < n; ++i) data[i] += b[i];
    return *this;
  }
  constexpr Vec& operator-=(const Vec& b) {
    IFSI_UNROLL
    for (int i = 0; i < n; ++i) data[i] -= b[i];
    return *this;
  }
};

/// to = from, number by number: compilers copy a whole struct in pieces narrower than a pack, and loads of a
/// pack then wait for the pieces.
template <class T, int n>
constexpr void copy(const Vec<T, n>& from, Vec<T, n>& to) {
  IFSI_UNROLL
  for (int i = 0; i < n; ++i) to[i] = from[i];
}

/// Matrix of rows x cols numbers of type T; m(i, j) is row i, column j.
template <class T, int rows, int cols = rows>
struct Mat {
  T data[rows * cols];

  constexpr T& operator()(int i, int j) { return data[i * cols + j]; }
  constexpr const T& operator()(int i, int j) const { return data[i * cols + j]; }
  static constexpr Mat zero() {
    Mat r;
    IFSI_UNROLL
    for (int k = 0; k < rows * cols; ++k) r.data[k] = T(0.0);
    return r;
  }
  static constexpr Mat identity() {
    Mat r = zero();
    IFSI_UNROLL
    for (int i = 0; i < (rows < cols ? rows : cols); ++i) r(i, i) = T(1.0);
    return r;
  }
  constexpr bool operator==(const Mat&) const = default;
  constexpr Mat& operator+=(const Mat& b) {
    IFSI_UNROLL
    for (int k = 0; k < rows * cols; ++k) data[k] += b.data[k];
    return *this;
  }
  constexpr Mat& operator-=(const Mat& b) {
    IFSI_UNROLL
    for (int k = 0; k < rows * cols; ++k) data[k] -= b.data[k];
    return *this;
  }
};

template <class T, int r, int c>
constexpr void copy(const Mat<T, r, c>& from, Mat<T, r, c>& to) {
  IFSI_UNROLL
  for (int k = 0; k < r * c; ++k) to.data[k] = from.data[k];
}

template <class T, int n>
constexpr Vec<T, n> operator+(Vec<T, n> a, const Vec<T, n>& b) {
  return a += b;
}
template <class T, int n>
constexpr Vec<T, n> operator-(Vec<T, n> a, const Vec<T, n>& b) {
  return a -= b;
}
template <class S, class T, int n>
constexpr Vec<T, n> operator*(const S& s, const Vec<T, n>& a) {
  Vec<T, n> r;
  IFSI_UNROLL
  for (int i = 0; i < n; ++i) r[i] = s * a[i];
  return r;
}
template <class T, int n>
constexpr T dot(const Vec<T, n>& a, const Vec<T, n>& b) {
  T r = a[0] * b[0];
  IFSI_UNROLL
  for (int i = 1; i < n; ++i) r += a[i] * b[i];
  return r;
}

template <class T, int r, int c>
constexpr Mat<T, r, c> operator+(Mat<T, r, c> a, const Mat<T, r, c>& b) {
  return a += b;
}
template <class T, int r, int c>
constexpr Mat<T, r, c> operator-(Mat<T, r, c> a, const Mat<T, r, c>& b) {
  return a -= b;
}
template <class S, class T, int r, int c>
constexpr Mat<T, r, c> operator*(const S& s, const Mat<T, r, c>& a) {
  Mat<T, r, c> m;
  IFSI_UNROLL
  for (int k = 0; k < r * c; ++k) m.data[k] = s * a.data[k];
  return m;
}
template <class T, int r, int k, int c>
constexpr Mat<T, r, c> operator*(const Mat<T, r, k>& a, const Mat<T, k, c>& b) {
  Mat<T, r, c> m = Mat<T, r, c>::zero();
  IFSI_UNROLL
  for (int i = 0; i < r; ++i) IFSI_UNROLL
  for (int l = 0; l < k; ++l) IFSI_UNROLL
  for (int j = 0; j < c; ++j) m(i, j) += a(i, l) * b(l, j);
  return m;
}
template <class T, int r, int c>
constexpr Vec<T, r> operator*(const Mat<T, r, c>& a, const Vec<T, c>& x) {
  Vec<T, r> y = Vec<T, r>::zero();
  IFSI_UNROLL
  for (int i = 0; i < r; ++i) IFSI_UNROLL
  for (int j = 0; j < c; ++j) y[i] += a(i, j) * x[j];
  return y;
}
template <class T, int r, int c>
constexpr Mat<T, c, r> transpose(const Mat<T, r, c>& a) {
  Mat<T, c, r> m;
  IFSI_UNROLL
  for (int i = 0; i < r; ++i) IFSI_UNROLL
  for (int j = 0; j < c; ++j) m(j, i) = a(i, j);
  return m;
}
template <class T, int n>
constexpr T trace(const Mat<T, n>& a) {
  T r = a(0, 0);
  IFSI_UNROLL
  for (int i = 1; i < n; ++i) r += a(i, i);
  return r;
}
/// Adds s times the identity.
template <class T, int n>
constexpr void add_to_diagonal(Mat<T, n>& a, const T& s) {
  IFSI_UNROLL
  for (int i = 0; i < n; ++i) a(i, i) += s;
}
/// Double contraction a : b = sum_ij a_ij b_ij.
template <class T, int r, int c>
constexpr T inner(const Mat<T, r, c>& a, const Mat<T, r, c>& b) {
  T s = a.data[0] * b.data[0];
  IFSI_UNROLL
  for (int k = 1; k < r * c; ++k) s += a.data[k] * b.data[k];
  return s;
}
/// Dyad (a (x) b)_ij = a_i b_j.
template <class T, int r, int c>
constexpr Mat<T, r, c> outer(const Vec<T, r>& a, const Vec<T, c>& b) {
  Mat<T, r, c> m;
  IFSI_UNROLL
  for (int i = 0; i < r; ++i) IFSI_UNROLL
  for (int j = 0; j < c; ++j) m(i, j) = a[i] * b[j];
  return m;
}
/// Symmetric part (a + a^T) / 2.
template <class T, int n>
constexpr Mat<T, n> sym(const Mat<T, n>& a) {
  return 0.5 * (a + transpose(a));
}

template <class T, int n>
constexpr T det(const Mat<T, n>& a) {
  static_assert(n >= 1 && n <= 3);
  if constexpr (n == 1) {
    return a(0, 0);
  } else if constexpr (n == 2) {
    return T(a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0));
  } else {
    return T(a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) -
             a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
             a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0)));
  }
}

template <class T>
constexpr Vec<T, 3> cross(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}

/// det(a) a^-T, also where a is singular.
template <class T, int n>
constexpr Mat<T, n> cofactor(const Mat<T, n>& a) {
  static_assert(n == 2 || n == 3);
  if constexpr (n == 2) {
    return {a(1, 1), T(-a(1, 0)), T(-a(0, 1)), a(0, 0)};
  } else {
    Mat<T, n> c;
    IFSI_UNROLL
    for (int i = 0; i < 3; ++i) IFSI_UNROLL
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    }
    return c;
  }
}

/// Inverse by cofactors; the caller knows that det(a) != 0.
template <class T, int n>
constexpr Mat<T, n> inverse(const Mat<T, n>& a) {
  static_assert(n >= 1 && n <= 3);
  Mat<T, n> r;
  const T s = T(1.0) / det(a);
  if constexpr (n == 1) {
    r(0, 0) = s;
  } else if constexpr (n == 2) {
    r(0, 0) = s * a(1, 1);
    r(0, 1) = -(s * a(0, 1));
    r(1, 0) = -(s * a(1, 0));
    r(1, 1) = s * a(0, 0);
  } else {
    IFSI_UNROLL
    for (int i = 0; i < 3; ++i) IFSI_UNROLL
    for (int j = 0; j < 3; ++j) {
      const int i1 = (j + 1) % 3, i2 = (j + 2) % 3, j1 = (i + 1) % 3, j2 = (i + 2) % 3;
      r(i, j) = s * (a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1));
    }
  }
  return r;
}

}  // namespace ifsi
