// A membrane: its forces belong to its energy, and closed forms of flat sheets.
#include "ifsi/assembly/membrane_body.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/mesh/leaflet.hpp"

namespace {
using namespace ifsi;
using SheetLaw = TensionFibres<PlaneStress<NeoHookean>>;
using Sheet = MembraneBody<Quad2, SheetLaw>;
using Place = Vec<double, 3>;

constexpr double sheet_E = 1.3, sheet_nu = 0.4, sheet_t = 0.05;
const Place no_direction{0.0, 0.0, 1.0};  // cells know their own
const SheetLaw matrix_alone(PlaneStress(NeoHookean(Lame::from_young(sheet_E, sheet_nu))), 0.0, no_direction);
const SheetLaw with_fibres(PlaneStress(NeoHookean(Lame::from_young(sheet_E, sheet_nu))), 2.0, no_direction,
                           3.0, 0.7);
SolidParameters<3> sheet_parameters() {
  return {.rho_s = 1.7, .rho_f = 1.1, .mu_f = 0.0, .mu_s = 0.0, .gravity = {0.4, -0.5, -1.4}};
}
SolidParameters<3> massless() {
  return {.rho_s = 0.0, .rho_f = 0.0, .mu_f = 0.0, .mu_s = 0.0, .gravity = {}};
}

/// Random numbers in [-size, size].
std::vector<double> jolt(int n, double size, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<double> x(n);
  for (double& value : x) value = uniform(random);
  return x;
}
/// Half of a leaflet, curved both ways, free of its plane of symmetry.
Sheet curved_sheet(const SolidParameters<3>& solid, double bending, const SheetLaw& law = with_fibres) {
  auto mesh = leaflet_membrane<Quad2>(AorticRoot{}, {}, 0.35, true).mesh;
  mesh.mirrored.clear();
  return {"leaflet", std::move(mesh), law, solid, sheet_t, bending};
}
/// [0, 2] x [0, 1], each point x taken to X(x).
template <class Map>
SurfaceMesh<Quad2> flat_mesh(Map&& X) {
  const auto flat = box<Quad2>({0.0, 0.0}, {2.0, 1.0}, {3, 2});
  SurfaceMesh<Quad2> mesh;
  mesh.cells = flat.cells;
  for (const auto& x : flat.points) mesh.points.push_back(X(x));
  return mesh;
}

std::vector<double> moved(const Sheet& body, const auto& map) {
  std::vector<double> u;
  for (const Place& X : body.mesh().points) {
    const Place x = map(X) - X;
    u.insert(u.end(), x.data, x.data + 3);
  }
  return u;
}
Place turned(const Place& X) {
  const double c = std::cos(2.1), s = std::sin(2.1);
  return Mat<double, 3>{c, 0, s, 0, 1, 0, -s, 0, c} * (Mat<double, 3>{1, 0, 0, 0, c, -s, 0, s, c} * X) +
         Place{3.0, -1.0, 0.5};
}

std::vector<double> assembled(const Sheet& body, const SolidState& state) {
  SolidCells nodes;
  body.list_cells(nodes, 0);
  EXPECT_EQ(nodes.size(), body.n_cells());
  std::vector<double> R(body.n_dofs());
  const auto report = body.residual(state, body.all_cells(), [&](int c, std::span<const double> R_c) {
    ASSERT_EQ(R_c.size(), 3 * nodes[c].size());
    for (std::size_t k = 0; k < R_c.size(); ++k) R[3 * nodes[c][k / 3] + k % 3] += R_c[k];
  });
  EXPECT_FALSE(report.inverted());
  return R;
}
/// The assembled tangent times a direction.
std::vector<double> tangent_times(const Sheet& body, const SolidState& state, const StateSlopes& slopes,
                                  const std::vector<double>& w) {
  SolidCells nodes;
  body.list_cells(nodes, 0);
  std::vector<double> y(body.n_dofs());
  const auto add = [&](int c, std::span<const double>, std::span<const double> K) {
    const std::size_t n = nodes[c].size();
    ASSERT_EQ(K.size(), 9 * n * n);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            y[3 * nodes[c][a] + i] += K[(a * n + b) * 9 + 3 * i + j] * w[3 * nodes[c][b] + j];
  };
  body.residual_and_tangent(state, slopes, body.all_cells(), add);
  return y;
}
std::vector<double> sum(std::vector<double> x, double factor, const std::vector<double>& y) {
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += factor * y[k];
  return x;
}

TEST(MembraneBody, ForcesAreTheDerivativeOfTheEnergy) {
  const auto body = curved_sheet(massless(), 0.3);
  const auto u = jolt(body.n_dofs(), 0.01, 3);
  const auto R = assembled(body, {u});
  const auto energy = [&](const std::vector<double>& w) {
    return body.totals({w}, body.all_cells()).elastic_energy;
  };
  for (int seed : {11, 12, 13}) {
    const auto w = jolt(body.n_dofs(), 1.0, seed);
    double power = 0.0;
    for (std::size_t k = 0; k < w.size(); ++k) power += R[k] * w[k];
    EXPECT_NEAR((energy(sum(u, 1e-5, w)) - energy(sum(u, -1e-5, w))) / 2e-5, power, 1e-7 * std::abs(power));
  }
}

// Bending apart: its tangent is exact where the sheet is as curved as undeformed (see SheetBending).
TEST(MembraneBody, TangentIsTheDerivativeOfTheResidual) {
  const auto body = curved_sheet(sheet_parameters(), 0.0);
  const auto u = jolt(body.n_dofs(), 0.01, 3), a = jolt(body.n_dofs(), 1.0, 4),
             w = jolt(body.n_dofs(), 1.0, 5);
  for (const auto& slopes :
       {StateSlopes{1.0, 0.0, 0.0}, StateSlopes{0.0, 0.0, 2.0}, StateSlopes{0.7, 0.0, 30.0}}) {
    const auto Kw = tangent_times(body, {u, {}, a}, slopes, w);
    const double h = 1e-6;  // fibres that slacken within it would show
    const auto at = [&](double s) {
      return assembled(body, {sum(u, s * slopes.u, w), {}, sum(a, s * slopes.a, w)});
    };
    const auto more = at(h), less = at(-h);
    double largest = 0.0;
    for (std::size_t k = 0; k < w.size(); ++k) {
      EXPECT_NEAR(Kw[k], (more[k] - less[k]) / (2.0 * h), 1e-7);
      largest = std::max(largest, std::abs(Kw[k]));
    }
    EXPECT_GT(largest, 1e-3);
  }
}

// Without fibres, whose tangent jumps there.
TEST(MembraneBody, TangentWithBendingAtRest) {
  const auto body = curved_sheet(sheet_parameters(), 0.3, matrix_alone);
  const auto u = moved(body, turned), w = jolt(body.n_dofs(), 1.0, 5);
  const auto Kw = tangent_times(body, {u}, {0.7, 0.0, 0.0}, w);
  const auto more = assembled(body, {sum(u, 0.7e-6, w)}), less = assembled(body, {sum(u, -0.7e-6, w)});
  for (std::size_t k = 0; k < w.size(); ++k) EXPECT_NEAR(Kw[k], (more[k] - less[k]) / 2e-6, 1e-6);
}

// Membrane and bending: what is symmetric has half of its energy in either half.
TEST(MembraneBody, HalfOfALeafletHasHalfOfTheEnergy) {
  const auto energy = [](bool half, double bending) {
    const Sheet body("leaflet", leaflet_membrane<Quad2>(AorticRoot{}, {}, 0.2, half).mesh, with_fibres,
                     massless(), sheet_t, bending);
    const auto u = moved(body, [](const Place& X) {
      return Place{X[0] + 0.2 * X[1] * X[1], X[1] * (1.1 + 0.1 * X[2]), X[2] - 0.3 * X[0] * X[0]};
    });
    return body.totals({u}, body.all_cells()).elastic_energy;
  };
  for (double bending : {0.0, 1e3})
    EXPECT_NEAR(2.0 * energy(true, bending), energy(false, bending), 1e-9 * energy(false, bending));
  EXPECT_GT(energy(true, 1e3), 10.0 * energy(true, 0.0));
}

TEST(MembraneBody, RigidMotionsAreFree) {
  const auto body = curved_sheet(massless(), 0.3);
  const auto u = moved(body, turned);
  for (double r : assembled(body, {u})) EXPECT_NEAR(r, 0.0, 1e-12);  // round-off of x times B / h^2
  const auto t = body.totals({u}, body.all_cells());
  EXPECT_NEAR(t.elastic_energy, 0.0, 1e-14);
  EXPECT_NEAR(t.volume, t.reference_volume, 1e-14);
}

TEST(MembraneBody, InternalForcesBalance) {
  const auto body = curved_sheet(massless(), 0.3);
  const auto u = jolt(body.n_dofs(), 0.01, 3);
  const auto R = assembled(body, {u});
  Place force{}, moment{};
  double size = 0.0;
  for (int a = 0; a < body.n_nodes(); ++a) {
    const Place R_a{R[3 * a], R[3 * a + 1], R[3 * a + 2]}, u_a{u[3 * a], u[3 * a + 1], u[3 * a + 2]};
    force += R_a, moment += cross(body.mesh().points[a] + u_a, R_a);
    size += std::sqrt(dot(R_a, R_a));
  }
  EXPECT_GT(size, 1.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(force[i], 0.0, 1e-13 * size);
    EXPECT_NEAR(moment[i], 0.0, 1e-13 * size);
  }
}

// Crosses have no mass: the sheet's is its density times thickness times area.
TEST(MembraneBody, MovesWithItsMass) {
  const auto body = curved_sheet(sheet_parameters(), 0.3);
  std::vector<double> v(body.n_dofs());
  for (int k = 0; k < body.n_dofs(); ++k) v[k] = 0.5 - k % 3;
  const auto t = body.totals({std::vector<double>(body.n_dofs()), v}, body.all_cells());
  EXPECT_NEAR(t.reference_volume, sheet_t * 1.66, 0.05 * sheet_t);  // cm^2: see LeafletMeshes
  const double mass = 1.7 * t.reference_volume;
  EXPECT_NEAR(t.kinetic_energy, 0.5 * mass * (0.25 + 0.25 + 2.25), 1e-13);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(t.momentum[i], mass * (0.5 - i), 1e-13);
  // With an acceleration the excess mass resists, less its weight.
  const auto R = assembled(body, {std::vector<double>(body.n_dofs()), {}, v});
  Place force{};
  for (int k = 0; k < body.n_dofs(); ++k) force[k % 3] += R[k];
  const auto g = sheet_parameters().gravity;
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(force[i], (1.7 - 1.1) * t.reference_volume * (0.5 - i - g[i]), 1e-13);
}

/// The thickness stretch d of a neo-Hookean sheet stretched by a and b: mu (d - 1/d) + lambda ln(a b d)/d =
/// 0.
double thinned(const Lame& lame, double a, double b) {
  double low = 0.01, high = 100.0;
  for (int k = 0; k < 200; ++k) {
    const double d = 0.5 * (low + high);
    (lame.mu * (d * d - 1.0) + lame.lambda * std::log(a * b * d) > 0.0 ? high : low) = d;
  }
  return low;
}

// Uniformly stretched, wherever its plane is: stress, energy and fields in closed form, and no force inside.
TEST(MembraneBody, UniformStretchOfAFlatSheet) {
  const Lame lame = Lame::from_young(sheet_E, sheet_nu);
  const double a = 1.4, b = 0.9, d = thinned(lame, a, b), J = a * b * d;
  const auto in_plane = [](double x, double y) { return turned({x, y, 0.0}); };
  const Sheet body("sheet", flat_mesh([&](const auto& x) { return in_plane(x[0] + 0.2 * x[1], x[1]); }),
                   matrix_alone, massless(), sheet_t, 0.0);
  std::vector<double> u;
  const auto flat = flat_mesh([&](const auto& x) { return Place{a * (x[0] + 0.2 * x[1]), b * x[1], 0.0}; });
  for (int p = 0; p < body.n_nodes(); ++p) {
    const Place u_p = in_plane(flat.points[p][0], flat.points[p][1]) - body.mesh().points[p];
    u.insert(u.end(), u_p.data, u_p.data + 3);
  }
  const auto kirchhoff = [&](double stretch) {
    return lame.mu * (stretch * stretch - 1.0) + lame.lambda * std::log(J);
  };
  const double volume = 2.0 * sheet_t;
  const auto t = body.totals({u}, body.all_cells());
  EXPECT_NEAR(t.reference_volume, volume, 1e-14);
  EXPECT_NEAR(t.volume, J * volume, 1e-13);
  const double psi = 0.5 * lame.mu * (a * a + b * b + d * d - 3.0 - 2.0 * std::log(J)) +
                     0.5 * lame.lambda * std::log(J) * std::log(J);
  EXPECT_NEAR(t.elastic_energy, psi * volume, 1e-13);
  // The forces on the edges: P = tau / stretch times the edge of the middle surface.
  const auto R = assembled(body, {u});
  double work = 0.0;
  for (int p = 0; p < body.n_nodes(); ++p) {
    const Place X = body.mesh().points[p], R_p{R[3 * p], R[3 * p + 1], R[3 * p + 2]};
    work += dot(R_p, X - Place{3.0, -1.0, 0.5});
    const Place on = flat.points[p];
    const double x = on[0] / a - 0.2 * on[1] / b, y = on[1] / b;
    if (x > 1e-9 && x < 2.0 - 1e-9 && y > 1e-9 && y < 1.0 - 1e-9) {
      EXPECT_NEAR(dot(R_p, R_p), 0.0, 1e-28);
    }
  }
  EXPECT_NEAR(work, volume * (kirchhoff(a) / a + kirchhoff(b) / b), 1e-13);  // int P : I dV
  const auto f = body.fields(u);
  const double first = kirchhoff(a) / J, second = kirchhoff(b) / J;
  for (int p = 0; p < body.n_nodes(); ++p) {
    EXPECT_NEAR(f.det_F[p], J, 1e-13);
    EXPECT_NEAR(f.principal[3 * p], first, 1e-12);
    EXPECT_NEAR(f.principal[3 * p + 1], std::max(second, 0.0), 1e-12);
    EXPECT_NEAR(f.principal[3 * p + 2], std::min(second, 0.0), 1e-12);
    EXPECT_NEAR(f.principal_strain[3 * p], 0.5 * (a * a - 1.0), 1e-12);
  }
  PrincipalSamples samples;
  body.add_principal_samples(u, samples);
  double sampled = 0.0;
  for (const auto& s : samples.stress) {
    EXPECT_NEAR(s.value, first, 1e-12);
    sampled += s.volume;
  }
  for (const auto& s : samples.strain) EXPECT_NEAR(s.value, 0.5 * (a * a - 1.0), 1e-12);
  EXPECT_NEAR(sampled, volume, 1e-14);
}

// Along the first local axis of a cell, in the plane at right angles to it across.
TEST(MembraneBody, FibresRunAlongTheCells) {
  const Sheet body("sheet", flat_mesh([](const auto& x) {
                     return Place{0.0, x[0], x[1]};
                   }),
                   with_fibres, massless(), sheet_t, 0.0);
  const Sheet alone("sheet", body.mesh(), matrix_alone, massless(), sheet_t, 0.0);
  const auto excess = [&](double along, double across) {
    const auto u = moved(body, [&](const Place& X) { return Place{0.0, along * X[1], across * X[2]}; });
    return body.totals({u}, body.all_cells()).elastic_energy -
           alone.totals({u}, body.all_cells()).elastic_energy;
  };
  const auto psi = [](double modulus, double l) {
    const double e = 0.5 * (l * l - 1.0);
    return modulus / 6.0 * (std::exp(3.0 * e * e) - 1.0);
  };
  EXPECT_NEAR(excess(1.2, 0.9), 2.0 * sheet_t * psi(2.0, 1.2), 1e-14);
  EXPECT_NEAR(excess(0.9, 1.2), 2.0 * sheet_t * psi(0.7, 1.2), 1e-14);
  EXPECT_EQ(excess(0.9, 0.8), 0.0);
}

TEST(MembraneBody, FacesAreBothSides) {
  const auto body = curved_sheet(massless(), 0.3);
  double area = 0.0;
  int faces = 0;
  body.for_each_face([&](std::span<const int> nodes, std::span<const double> areas) {
    ASSERT_EQ(nodes.size(), areas.size());
    for (double part : areas) area += part;
    ++faces;
  });
  EXPECT_EQ(faces, body.mesh().n_cells());
  const auto at_rest = std::vector<double>(body.n_dofs());
  EXPECT_NEAR(area, 2.0 * body.totals({at_rest}, body.all_cells()).reference_volume / sheet_t, 1e-13);
}

// A state that is no number is reported, and hands nothing out.
TEST(MembraneBody, ReportsWhatIsNoState) {
  const auto body = curved_sheet(massless(), 0.0);
  std::vector<double> u(body.n_dofs());
  u[3 * body.mesh().cells[2][4]] = NAN;  // the middle of the cell: no other has it
  int handed_out = 0;
  const auto report = body.residual({u}, body.all_cells(),
                                    [&](int c, std::span<const double>) { handed_out += c == 2 ? 100 : 1; });
  EXPECT_TRUE(report.inverted());
  EXPECT_EQ(report.cell, 2);
  EXPECT_EQ(handed_out, body.n_cells() - 1);
}

void expect_refused(const SurfaceMesh<Quad2>& mesh, const SolidParameters<3>& solid, double thickness,
                    double bending, ExitCode code, const std::string& words) {
  try {
    Sheet("sheet", mesh, matrix_alone, solid, thickness, bending);
    ADD_FAILURE() << "accepted; expected a complaint about " << words;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code);
    EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
  }
}

TEST(MembraneBody, RefusesWhatIsNoMembrane) {
  const auto good = flat_mesh([](const auto& x) { return Place{x[0], x[1], 0.0}; });
  const auto configuration = ExitCode::configuration;
  expect_refused(good, massless(), 0.0, 0.0, configuration, "'sheet': thickness");
  expect_refused(good, massless(), INFINITY, 0.0, configuration, "thickness");
  expect_refused(good, massless(), sheet_t, -0.1, configuration, "bending stiffness");
  expect_refused(good, massless(), sheet_t, NAN, configuration, "bending stiffness");
  auto solid = massless();
  solid.rho_s = -1.0;
  expect_refused(good, solid, sheet_t, 0.0, configuration, "rho_s");
  solid = massless(), solid.rho_f = NAN;
  expect_refused(good, solid, sheet_t, 0.0, configuration, "rho_f");
  expect_refused({}, massless(), sheet_t, 0.0, ExitCode::file, "no cells");
  expect_refused(flat_mesh([](const auto& x) {
                   return Place{x[0], 0.0, 0.0};
                 }),
                 massless(), sheet_t, 0.0, ExitCode::file, "cell 0 has no area");
  auto wrong = good;
  wrong.cells[3][2] = wrong.n_points();
  expect_refused(wrong, massless(), sheet_t, 0.0, ExitCode::file, "cell 3");
  wrong = good, wrong.crosses.push_back({0, 1, 2, 3, -1});
  expect_refused(wrong, massless(), sheet_t, 0.1, ExitCode::file, "node -1");
}
}  // namespace
