#pragma once
/// \file
/// Bending of a thin sheet whose nodes form a lattice.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// Bending stiffness of a sheet with one layer of nodes, by second differences along its two families of
/// lines (eq. 46). A stencil holds a node and its four neighbours,
///
///     E = w/2 sum_d B_d |k_d - k_d0|^2,    k_d = sum_k c_dk x_k,
///
/// k_d0 the second difference of the undeformed sheet, carried along by the frame (t_1, t_2, n) of the
/// differences t_d across the node and the unit normal n. Twist costs nothing, nor do edges bend.
class SheetBending {
 public:
  using Point = Vec<double, 3>;
  using Block = Mat<double, 3>;
  static constexpr int n = 5;  ///< nodes of a stencil: the middle, those before and behind along either line
  using Nodes = std::array<int, n>;

  struct Term {
    double energy = 0.0;
    std::array<Point, n> R{};
    std::array<Block, n * n> K{};
  };

  /// Adds the stencil of these nodes, at X undeformed. \param B moment per length over curvature along either
  /// line. \throws Error (file) where both lines are one, or points coincide.
  void add(const Nodes& nodes, const std::array<Point, n>& X, std::array<double, 2> B) {
    add_stencil(nodes, X, B, Block::identity(), 1.0);
  }
  /// The same of a node on a plane of symmetry through the origin, whose node 1 is the image of node 2: half
  /// of a stencil. \param normal of the plane, of length one; \pre nodes[1] = nodes[2]
  void add_mirrored(const Nodes& nodes, const std::array<Point, n>& X, std::array<double, 2> B,
                    const Point& normal) {
    add_stencil(nodes, X, B, Block::identity() - 2.0 * outer(normal, normal), 0.5);
  }

  [[nodiscard]] const std::vector<Nodes>& nodes() const { return nodes_; }
  [[nodiscard]] int size() const { return static_cast<int>(stencils_.size()); }

  /// Energy, forces as a residual and their slopes with nodes at x. The slopes leave out the curvature of
  /// k_d0: they are positive semi-definite, and exact where the sheet is as curved as undeformed.
  [[nodiscard]] Term term(int stencil, std::array<Point, n> x) const {
    const Stencil& s = stencils_[stencil];
    x[1] = s.image * x[1];
    const Frame f(s, x);
    Term t;
    for (int d = 0; d < 2; ++d) {
      const Point r = second_difference(s, x, d) - f.axes() * s.rest[d];
      const double c = s.area * s.B[d];
      t.energy += 0.5 * c * dot(r, r);
      std::array<Block, n> G;  // of r, per node
      for (int k = 0; k < n; ++k) {
        G[k] = s.difference(d, k) * Block::identity() - f.slope(s, k, s.rest[d]);
        if (k == 1) G[k] = G[k] * s.image;
        t.R[k] += c * (transpose(G[k]) * r);
      }
      for (int k = 0; k < n; ++k)
        for (int l = 0; l < n; ++l) t.K[k * n + l] += c * (transpose(G[k]) * G[l]);
    }
    return t;
  }

 private:
  void add_stencil(const Nodes& nodes, std::array<Point, n> X, std::array<double, 2> B, const Block& image,
                   double part) {
    Stencil s;
    s.B = B, s.image = image;
    X[1] = image * X[1];
    std::array<double, 2> width;
    double shortest = length(X[1] - X[0]);
    for (int d = 0; d < 2; ++d) {
      const double before = length(X[1 + 2 * d] - X[0]), behind = length(X[2 + 2 * d] - X[0]);
      s.before[d] = 2.0 / (before * (before + behind)), s.behind[d] = 2.0 / (behind * (before + behind));
      s.across[d] = 1.0 / (before + behind);
      width[d] = 0.5 * (before + behind), shortest = std::min({shortest, before, behind});
    }
    const Frame f(s, X);
    s.area = part * width[0] * width[1] * f.size;
    if (!(shortest > 0.0 && f.size > 1e-8))  // size: about the sine between them
      throw Error(ExitCode::file,
                  "the lines that cross at node " + std::to_string(nodes[0]) + " of a sheet span no area");
    for (int d = 0; d < 2; ++d) s.rest[d] = inverse(f.axes()) * second_difference(s, X, d);
    nodes_.push_back(nodes), stencils_.push_back(s);
  }

  struct Stencil {
    std::array<double, 2> B, before, behind, across;
    double area;
    std::array<Point, 2> rest;  ///< k_d0 in the frame
    Block image;                ///< of node 1: identity, or the reflection in a plane of symmetry

    /// c_dk.
    [[nodiscard]] double difference(int d, int k) const {
      if (k == 0) return -before[d] - behind[d];
      if ((k - 1) / 2 != d) return 0.0;
      return k % 2 == 1 ? before[d] : behind[d];
    }
    /// Slope of t_d with node k.
    [[nodiscard]] double first_difference(int d, int k) const {
      if (k == 0 || (k - 1) / 2 != d) return 0.0;
      return k % 2 == 1 ? -across[d] : across[d];
    }
  };
  static double length(const Point& x) { return std::sqrt(dot(x, x)); }
  static Point second_difference(const Stencil& s, const std::array<Point, n>& x, int d) {
    Point k = Point::zero();
    for (int a = 0; a < n; ++a) k += s.difference(d, a) * x[a];
    return k;
  }

  /// t_1, t_2 and n of a stencil.
  struct Frame {
    Point t1 = Point::zero(), t2 = Point::zero(), normal;
    double size;  ///< |t_1 x t_2|

    Frame(const Stencil& s, const std::array<Point, n>& x) {
      for (int a = 0; a < n; ++a)
        t1 += s.first_difference(0, a) * x[a], t2 += s.first_difference(1, a) * x[a];
      normal = cross(t1, t2);
      size = length(normal);
      normal = (1.0 / size) * normal;
    }
    [[nodiscard]] Block axes() const {
      return {t1[0], t2[0], normal[0], t1[1], t2[1], normal[1], t1[2], t2[2], normal[2]};
    }
    /// Of axes() * rest with node k.
    [[nodiscard]] Block slope(const Stencil& s, int k, const Point& rest) const {
      const double d1 = s.first_difference(0, k), d2 = s.first_difference(1, k);
      Block G = (d1 * rest[0] + d2 * rest[1]) * Block::identity();
      for (int j = 0; j < 3; ++j) {
        Point e = Point::zero();
        e[j] = 1.0;
        Point dn = (1.0 / size) * (d1 * cross(e, t2) + d2 * cross(t1, e));
        dn = dn - dot(dn, normal) * normal;
        for (int i = 0; i < 3; ++i) G(i, j) += rest[2] * dn[i];
      }
      return G;
    }
  };

  std::vector<Nodes> nodes_;
  std::vector<Stencil> stencils_;
};

}  // namespace ifsi
