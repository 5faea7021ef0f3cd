// A body on a distorted mesh: loops and batches, balances, loads, output, and bad input.
#include <gtest/gtest.h>

#include "ifsi/mesh/generators.hpp"
#include "solid/sample_bodies.hpp"

namespace {
using namespace ifsi;
using namespace ifsi::testing;

/// The box [1,3] x [0,1] (x [0,1]), 3 x 2 (x 2) cells, nodes moved at random, those of the boundary within
/// it.
template <class Element>
GlobalMesh<Element> distorted_box(double size = 0.06) {
  constexpr int dim = Element::dim;
  GlobalMesh<Element> mesh;
  if constexpr (dim == 2)
    mesh = box<Element>({1, 0}, {3, 1}, {3, 2});
  else
    mesh = box<Element>({1, 0, 0}, {3, 1, 1}, {3, 2, 2});
  const auto d = noise(mesh.n_points() * dim, size / Element::order, 1);
  for (int a = 0; a < mesh.n_points(); ++a)
    for (int i = 0; i < dim; ++i) {
      double& x = mesh.points[a][i];
      const double low = i == 0 ? 1 : 0, high = i == 0 ? 3 : 1;
      if (x > low + 1e-9 && x < high - 1e-9) x += d[a * dim + i];
    }
  return mesh;
}

template <int dim, class Map>
std::vector<double> nodal(const std::vector<Vec<double, dim>>& points, Map map) {
  std::vector<double> u;
  for (const auto& X : points) {
    const Vec<double, dim> value = map(X);
    u.insert(u.end(), value.data, value.data + dim);
  }
  return u;
}

/// Assembled residual of a body.
template <class Body>
std::vector<double> residual(const Body& body, const SolidState& state) {
  std::vector<double> R(body.n_dofs());
  body.residual(state, body.all_cells(), [&](int cell, std::span<const double> R_e) {
    for (int k = 0; k < Body::n_cell_dofs; ++k)
      R[body.mesh().cells[cell][k / Body::dim] * Body::dim + k % Body::dim] += R_e[k];
  });
  return R;
}

template <int dim>
Mat<double, dim> some_gradient() {
  Mat<double, dim> H = {};
  for (int k = 0; k < dim * dim; ++k) H.data[k] = 0.11 * std::sin(3.0 * k + 1);
  return H;
}
template <int dim>
Mat<double, dim> some_rotation() {
  Mat<double, dim> Q = Mat<double, dim>::identity();
  Q(0, 0) = Q(1, 1) = std::cos(2.3);
  Q(1, 0) = std::sin(2.3);
  Q(0, 1) = -Q(1, 0);
  return Q;
}

template <class Element_, class Formulation_ = Displacement, class Coordinates_ = Cartesian>
struct Case {
  using Element = Element_;
  using Coordinates = Coordinates_;
  using Body = SolidBody<Element_, UncoupledNeoHookean, Formulation_, Coordinates_>;
};

template <class C>
class SolidBodyContract : public ::testing::Test {
 protected:
  using Element = typename C::Element;
  using Body = typename C::Body;
  static constexpr int dim = Element::dim;
  static constexpr bool axisymmetric = C::Coordinates::axisymmetric;

  static Body make(SolidParameters<dim> p = {}) {
    return Body("sample", distorted_box<Element>(), UncoupledNeoHookean(1.3, 4.0), p);
  }
  static std::vector<double> affine(const Body& body, const Mat<double, dim>& H) {
    return nodal<dim>(body.mesh().points, [&](const Vec<double, dim>& X) { return H * X; });
  }
};
using Cases = ::testing::Types<Case<Tri2>, Case<Hex1>, Case<Wedge1, MeanDilatation>,
                               Case<Quad1, MeanDilatation, Axisymmetric>>;
TYPED_TEST_SUITE(SolidBodyContract, Cases);

TYPED_TEST(SolidBodyContract, BatchesComputeWhatTheScalarKernelDoes) {
  using Body = typename TestFixture::Body;
  constexpr int dim = Body::dim, n = Body::n;
  using Kernel = SolidCell<typename Body::Element, UncoupledNeoHookean, typename Body::Formulation,
                           typename Body::Coordinates, DefaultQuadrature<typename Body::Element>, double>;
  const auto body = TestFixture::make(immersed_parameters<dim>());
  const auto u = noise(body.n_dofs(), 0.04, 5), v = noise(body.n_dofs(), 1, 6),
             a = noise(body.n_dofs(), 1, 7);
  const StateSlopes slopes{0.7, 1.9, 3.1};
  std::vector<int> visited, cells = body.all_cells();
  std::swap(cells[1], cells[4]);
  cells.pop_back();
  const auto report = body.residual_and_tangent(
      {u, v, a}, slopes, cells, [&](int c, std::span<const double> R, std::span<const double> K) {
        visited.push_back(c);
        SolidCellData<typename Body::Element, double> data;
        for (int k = 0; k < Body::n_cell_dofs; ++k) {
          const int node = body.mesh().cells[c][k / dim], i = k % dim;
          data.X[k / dim][i] = body.mesh().points[node][i];
          data.u[k / dim][i] = u[node * dim + i];
          data.v[k / dim][i] = v[node * dim + i];
          data.a[k / dim][i] = a[node * dim + i];
        }
        Kernel(data, body.law())
            .residual_and_tangent(
                body.parameters, slopes,
                [&](int p, const Vec<double, dim>& R_p) {
                  for (int i = 0; i < dim; ++i) EXPECT_NEAR(R[p * dim + i], R_p[i], 1e-13);
                },
                [&](int p, int q, const Mat<double, dim>& K_pq) {
                  for (int k = 0; k < dim * dim; ++k)
                    EXPECT_NEAR(K[(p * n + q) * dim * dim + k], K_pq.data[k], 1e-12);
                });
      });
  EXPECT_EQ(visited, cells);
  EXPECT_FALSE(report.inverted());
  EXPECT_GT(report.min_det_F, 0.3);
  EXPECT_LT(report.min_det_F, 1);
}

TYPED_TEST(SolidBodyContract, RigidMotionsAreFree) {
  constexpr int dim = TestFixture::dim;
  const auto body = TestFixture::make();
  Vec<double, dim> shift{};
  shift[1] = 0.7;
  const Mat<double, dim> Q = TestFixture::axisymmetric ? Mat<double, dim>::identity() : some_rotation<dim>();
  const auto u = nodal<dim>(body.mesh().points, [&](const Vec<double, dim>& X) { return Q * X + shift - X; });
  for (double r : residual(body, {u})) EXPECT_NEAR(r, 0, 2e-13);
  EXPECT_NEAR(body.totals({u}, body.all_cells()).elastic_energy, 0, 1e-13);
}

/// Newton's third law inside the body: elastic and viscous forces add up to nothing, and have no moment.
TYPED_TEST(SolidBodyContract, InternalForcesBalance) {
  constexpr int dim = TestFixture::dim;
  SolidParameters<dim> viscous;
  viscous.rho_s = 0;
  viscous.mu_s = 0.8;
  const auto body = TestFixture::make(viscous);
  const auto u = noise(body.n_dofs(), 0.04, 5), v = noise(body.n_dofs(), 1, 6);
  const auto R = residual(body, {u, v});
  Vec<double, dim> force{};
  double moment = 0;
  for (int a = 0; a < body.n_nodes(); ++a) {
    for (int i = 0; i < dim; ++i) force[i] += R[a * dim + i];
    const double x = body.mesh().points[a][0] + u[a * dim], y = body.mesh().points[a][1] + u[a * dim + 1];
    moment += x * R[a * dim + 1] - y * R[a * dim];
  }
  for (int i = TestFixture::axisymmetric ? 1 : 0; i < dim; ++i) EXPECT_NEAR(force[i], 0, 1e-12);
  if (!TestFixture::axisymmetric) {
    EXPECT_NEAR(moment, 0, 1e-12);
  }
}

/// Patch test: the residual of a constant deformation gradient vanishes at inner nodes of any mesh. In (r, z)
/// that takes equal stretches along r and around the axis, and no shear.
TYPED_TEST(SolidBodyContract, ConstantStressIsInEquilibrium) {
  const auto body = TestFixture::make();
  auto H = some_gradient<TestFixture::dim>();
  if (TestFixture::axisymmetric) H(0, 1) = H(1, 0) = 0.0;
  const auto R = residual(body, {TestFixture::affine(body, H)});
  std::vector<bool> on_boundary(body.n_nodes());
  for (const auto& name : body.mesh().boundary_names)
    for (int node : body.nodes_on(name)) on_boundary[node] = true;
  int n_inner = 0;
  double largest = 0;
  for (int k = 0; k < body.n_dofs(); ++k) {
    if (on_boundary[k / TestFixture::dim]) {
      largest = std::max(largest, std::abs(R[k]));
    } else {
      EXPECT_NEAR(R[k], 0, 1e-13);
      ++n_inner;
    }
  }
  EXPECT_GT(n_inner, 0);
  EXPECT_GT(largest, 0.01);
}

TYPED_TEST(SolidBodyContract, TotalsOfAHomogeneousMotion) {
  constexpr int dim = TestFixture::dim;
  SolidParameters<dim> p;
  p.rho_s = 1.7;
  const auto body = TestFixture::make(p);
  Mat<double, dim> H = some_gradient<dim>();
  if (TestFixture::axisymmetric) H = {0.2, 0, 0, -0.1};
  Mat<double, dim> F = H + Mat<double, dim>::identity();
  const double V = TestFixture::axisymmetric ? std::numbers::pi * 8 : 2;
  const double J = det(F) * (TestFixture::axisymmetric ? 1.2 : 1);
  std::vector<double> v(body.n_dofs());
  for (int k = 0; k < body.n_dofs(); ++k) v[k] = 0.5 - k % dim;
  const auto t = body.totals({TestFixture::affine(body, H), v}, body.all_cells());
  EXPECT_NEAR(t.reference_volume, V, 1e-12);
  EXPECT_NEAR(t.volume, J * V, 1e-12);
  EXPECT_NEAR(t.deformation.min_det_F, J, 1e-13);
  double psi;
  if constexpr (TestFixture::axisymmetric)
    psi = body.law().psi(Mat<double, 3>{1.2, 0, 0, 0, 0.9, 0, 0, 0, 1.2}, Vec<double, 2>{});
  else
    psi = body.law().psi(F, Vec<double, dim>{});
  EXPECT_NEAR(t.elastic_energy, psi * V, 1e-12);
  double v2 = 0;
  for (int i = 0; i < dim; ++i) {
    v2 += (0.5 - i) * (0.5 - i);
    EXPECT_NEAR(t.momentum[i], 1.7 * V * (0.5 - i), 1e-12);
  }
  EXPECT_NEAR(t.kinetic_energy, 0.5 * 1.7 * V * v2, 1e-12);
}

/// Weight less buoyancy of the displaced volume, as it is now.
TYPED_TEST(SolidBodyContract, ExcessWeight) {
  constexpr int dim = TestFixture::dim;
  SolidParameters<dim> p;
  p.rho_s = 1.7;
  p.rho_f = 1.1;
  p.gravity[1] = -9;
  const auto body = TestFixture::make(p);
  const auto u = noise(body.n_dofs(), 0.04, 5);
  const auto R = residual(body, {u}), R_elastic = residual(TestFixture::make(), {u});
  const auto t = body.totals({u}, body.all_cells());
  double force = 0;
  for (int k = 1; k < body.n_dofs(); k += dim) force += R_elastic[k] - R[k];
  EXPECT_NEAR(force, (1.7 * t.reference_volume - 1.1 * t.volume) * -9, 1e-11);
}

/// Power of the excess viscous stress in a homogeneous flow: 2 (mu_s - mu_f) eps : eps times current volume.
TYPED_TEST(SolidBodyContract, ViscousPower) {
  constexpr int dim = TestFixture::dim;
  SolidParameters<dim> p;
  p.rho_s = 0;
  p.mu_f = 0.6;
  p.mu_s = 0.1;
  const auto body = TestFixture::make(p);
  const auto u = noise(body.n_dofs(), 0.04, 5);
  Mat<double, dim> L = some_gradient<dim>();  // spatial velocity gradient: v = L x
  if (TestFixture::axisymmetric) L = {0.3, 0, 0.2, -0.5};
  auto v = TestFixture::affine(body, L);
  for (int a = 0; a < body.n_nodes(); ++a) {
    Vec<double, dim> u_a;
    for (int i = 0; i < dim; ++i) u_a[i] = u[a * dim + i];
    const Vec<double, dim> add = L * u_a;
    for (int i = 0; i < dim; ++i) v[a * dim + i] += add[i];
  }
  p.mu_f = p.mu_s = 0;
  const auto R = residual(body, {u, v}), R_elastic = residual(TestFixture::make(p), {u, v});
  double power = 0;
  for (int k = 0; k < body.n_dofs(); ++k) power += (R[k] - R_elastic[k]) * v[k];
  const auto eps = sym(L);
  const double hoop = TestFixture::axisymmetric ? 0.3 * 0.3 : 0;
  const double volume = body.totals({u}, body.all_cells()).volume;
  EXPECT_NEAR(power, 2 * (0.1 - 0.6) * (inner(eps, eps) + hoop) * volume, 1e-12);
}

/// Pressure all around does the work p dV: its residual is p times the gradient of the volume.
TYPED_TEST(SolidBodyContract, PressureIsTheGradientOfVolume) {
  const auto body = TestFixture::make();
  auto u = noise(body.n_dofs(), 0.04, 5);
  std::vector<double> R(body.n_dofs());
  for (const auto& name : body.mesh().boundary_names)
    body.add_pressure(2.5, u, {}, body.faces_on(name),
                      [&](std::span<const int> nodes, std::span<const double> R_f, std::span<const double>) {
                        for (std::size_t k = 0; k < R_f.size(); ++k)
                          R[nodes[k / TestFixture::dim] * TestFixture::dim + k % TestFixture::dim] += R_f[k];
                      });
  const auto cells = body.all_cells();
  for (int k = 0; k < body.n_dofs(); ++k) {
    const double u_k = u[k], h = 1e-5;
    u[k] = u_k + h;
    const double more = body.totals({u}, cells).volume;
    u[k] = u_k - h;
    const double less = body.totals({u}, cells).volume;
    u[k] = u_k;
    EXPECT_NEAR(R[k], 2.5 * (more - less) / (2 * h), 1e-8);
  }
}

TYPED_TEST(SolidBodyContract, PressureTangentIsConsistent) {
  constexpr int dim = TestFixture::dim;
  const auto body = TestFixture::make();
  const auto u = noise(body.n_dofs(), 0.04, 5);
  std::vector<int> faces;
  for (const char* name : {"right", "top"}) {
    const auto some = body.faces_on(name);
    faces.insert(faces.end(), some.begin(), some.end());
  }
  for (int f : faces) {
    std::vector<double> K;
    std::vector<int> nodes;
    const auto R_at = [&](const std::vector<double>& w) {
      std::vector<double> R;
      body.add_pressure(
          2.5, w, {0.7, 0, 0}, std::array{f},
          [&](std::span<const int> nodes_f, std::span<const double> R_f, std::span<const double> K_f) {
            nodes.assign(nodes_f.begin(), nodes_f.end());
            R.assign(R_f.begin(), R_f.end());
            K.assign(K_f.begin(), K_f.end());
          });
      return R;
    };
    R_at(u);
    const auto K_at_u = K;
    const int m = static_cast<int>(nodes.size());
    for (int b = 0; b < m * dim; ++b) {
      auto more = u, less = u;
      more[nodes[b / dim] * dim + b % dim] += 1e-5;
      less[nodes[b / dim] * dim + b % dim] -= 1e-5;
      const auto R_more = R_at(more), R_less = R_at(less);
      for (int a = 0; a < m * dim; ++a)
        EXPECT_NEAR(K_at_u[(a / dim * m + b / dim) * dim * dim + a % dim * dim + b % dim],
                    0.7 * (R_more[a] - R_less[a]) / 2e-5, 1e-8);
    }
  }
}

TYPED_TEST(SolidBodyContract, DeadTractionAddsUpToForce) {
  constexpr int dim = TestFixture::dim;
  const auto body = TestFixture::make();
  Vec<double, dim> traction{}, force{};
  traction[0] = 2;
  traction[1] = -3;
  body.add_traction(traction, body.faces_on("right"), [&](std::span<const int>, std::span<const double> R) {
    for (std::size_t k = 0; k < R.size(); ++k) force[k % dim] -= R[k];
  });
  const double area = TestFixture::axisymmetric ? 2 * std::numbers::pi * 3 : 1;
  EXPECT_NEAR(force[0], 2 * area, 1e-12);
  EXPECT_NEAR(force[1], -3 * area, 1e-12);
}

TYPED_TEST(SolidBodyContract, FieldsOfAHomogeneousDeformation) {
  constexpr int dim = TestFixture::dim;
  const auto body = TestFixture::make();
  Mat<double, dim> H = some_gradient<dim>();
  if (TestFixture::axisymmetric) H = {0.2, 0, 0, -0.1};
  Mat<double, 3> F = Mat<double, 3>::identity();
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) F(i, j) += H(i, j);
  if (TestFixture::axisymmetric) F(2, 2) = 1.2;
  const auto sigma = (1 / det(F)) * (body.law().first_piola(F, Vec<double, dim>{}) * transpose(F));
  const auto E = 0.5 * (transpose(F) * F - Mat<double, 3>::identity());
  const auto s = principal_values(sigma), e = principal_values(E);
  const auto u = TestFixture::affine(body, H);
  const auto f = body.fields(u);
  const int row[] = {0, 1, 2, 0, 1, 0}, column[] = {0, 1, 2, 1, 2, 2};
  for (int a = 0; a < body.n_nodes(); ++a) {
    EXPECT_NEAR(f.det_F[a], det(F), 1e-13);
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR(f.cauchy[6 * a + k], sigma(row[k], column[k]), 1e-12);
      EXPECT_NEAR(f.green_lagrange[6 * a + k], E(row[k], column[k]), 1e-13);
    }
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(f.principal[3 * a + k], s[k], 1e-12);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(f.principal_strain[3 * a + k], e[k], 1e-13);
  }
  PrincipalSamples samples;
  body.add_principal_samples(u, samples);
  double volume = 0.0;
  for (const auto& sample : samples.stress) {
    EXPECT_NEAR(sample.value, s[0], 1e-12);
    volume += sample.volume;
  }
  for (const auto& sample : samples.strain) EXPECT_NEAR(sample.value, e[0], 1e-13);
  EXPECT_NEAR(volume, body.totals({u}, body.all_cells()).reference_volume, 1e-12);
}

using Quads = SolidBody<Quad1, NeoHookean>;
Quads quads(SolidParameters<2> p = {}) {
  return Quads("flag", distorted_box<Quad1>(), NeoHookean(Lame{1, 2}), p);
}

// Simple shear by g and a stretch by l in plane strain, both turned: sigma = (mu (b - I) + lambda log J I) /
// J.
TEST(SolidBody, LargestPrincipalStressAndStrainInClosedForm) {
  const auto body = quads();
  constexpr double mu = 1, lambda = 2, g = 0.6, l = 1.3;
  const double shear = g * g / 2 + g * std::sqrt(1 + g * g / 4), angle = 0.7;
  const Mat<double, 2> Q = {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)};
  struct Example {
    Mat<double, 2> F;
    double stress, strain;
  };
  for (const auto& [F, stress, strain] :
       {Example{{1, g, 0, 1}, mu * shear, shear / 2},
        Example{{1, 0, 0, l}, (mu * (l * l - 1) + lambda * std::log(l)) / l, (l * l - 1) / 2}}) {
    const Mat<double, 2> H = Q * F - Mat<double, 2>::identity();
    PrincipalSamples samples;
    body.add_principal_samples(nodal<2>(body.mesh().points, [&](const auto& X) { return H * X; }), samples);
    EXPECT_NEAR(volume_quantile(samples.stress, 0.5), stress, 1e-13);
    EXPECT_NEAR(volume_quantile(samples.strain, 0.5), strain, 1e-13);
  }
}

/// Mean dilatation with a compressible law: the same homogeneous stress as without.
TEST(SolidBody, MeanDilatationKeepsHomogeneousStress) {
  const SolidBody<Quad1, NeoHookean, MeanDilatation> mean("flag", distorted_box<Quad1>(),
                                                          NeoHookean(Lame{1, 2}), {});
  const auto u = nodal<2>(mean.mesh().points, [](const Vec<double, 2>& X) { return some_gradient<2>() * X; });
  const auto expected = quads().fields(u).cauchy, found = mean.fields(u).cauchy;
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-13);
}

TEST(SolidBody, InvertedCellsAreReportedAndSkipped) {
  const auto body = quads();
  std::vector<double> u(body.n_dofs());
  const int node = body.mesh().cells[3][2];
  u[2 * node] = -1.5;
  std::vector<int> visited;
  const auto report = body.residual({u}, body.all_cells(), [&](int c, std::span<const double> R) {
    visited.push_back(c);
    for (double r : R) EXPECT_TRUE(std::isfinite(r));
  });
  EXPECT_TRUE(report.inverted());
  EXPECT_LT(report.min_det_F, 0);
  const auto& worst = body.mesh().cells[report.cell];
  EXPECT_NE(std::find(worst.begin(), worst.end(), node), worst.end());
  EXPECT_EQ(std::find(visited.begin(), visited.end(), report.cell), visited.end());
  EXPECT_LT(visited.size(), 6u);
  EXPECT_GT(visited.size(), 1u);
}

TEST(SolidBody, NotANumberCountsAsInverted) {
  const auto body = quads();
  std::vector<double> u(body.n_dofs());
  u[0] = NAN;
  const auto report = body.residual({u}, body.all_cells(), [](int, std::span<const double> R) {
    for (double r : R) EXPECT_TRUE(std::isfinite(r));
  });
  EXPECT_TRUE(report.inverted());
  EXPECT_EQ(report.cell, 0);
}

TEST(SolidBody, NodesOfABoundary) {
  const auto body = quads();
  for (int a : body.nodes_on("left")) EXPECT_EQ(body.mesh().points[a][0], 1);
  EXPECT_EQ(body.nodes_on("left").size(), 3u);
  EXPECT_EQ(body.faces_on("top").size(), 3u);
}

template <class Make>
void expect_error(ExitCode code, const std::vector<std::string>& words, Make make) {
  try {
    make();
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code);
    for (const auto& word : words) EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
  }
}

TEST(SolidBody, BadInputIsExplained) {
  using enum ExitCode;
  expect_error(configuration, {"flag", "rho_s", "-1"}, [] { quads({-1, 0, 0, 0, {}}); });
  expect_error(configuration, {"mu_f", "nan"}, [] { quads({1, 0, NAN, 0, {}}); });
  expect_error(configuration, {"flag", "lefft", "left"}, [] { (void)quads().boundary("lefft"); });
  expect_error(file, {"flag", "cell 4", "inside out"}, [] {
    auto mesh = distorted_box<Quad1>();
    std::swap(mesh.cells[4][0], mesh.cells[4][1]);
    Quads("flag", mesh, NeoHookean(Lame{1, 2}), {});
  });
  expect_error(file, {"no cells"}, [] { Quads("flag", {}, NeoHookean(Lame{1, 2}), {}); });
  expect_error(configuration, {"periodic"}, [] {
    Quads("flag", box<Quad1>({0, 0}, {1, 1}, {4, 4}, {{true, false}}), NeoHookean(Lame{1, 2}), {});
  });
  expect_error(file, {"r = -1"}, [] {
    SolidBody<Quad1, NeoHookean, Displacement, Axisymmetric>("ball", box<Quad1>({-1, 0}, {1, 1}, {2, 2}),
                                                             NeoHookean(Lame{1, 2}), {});
  });
}
}  // namespace
