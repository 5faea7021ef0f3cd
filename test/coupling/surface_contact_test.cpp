// Contact of points on surfaces: against all pairs without a list, derivatives, and what does not repel.
#include "ifsi/coupling/surface_contact.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {
using namespace ifsi;

constexpr double range = 0.3, pressure = 2.0;

/// Two clouds of points in the unit box, the second one above the first.
template <int dim>
struct Clouds {
  std::vector<SurfacePoint<dim>> points;
  std::vector<Vec<double, dim>> x;

  Clouds() {
    for (int node = 0; node < 60; ++node) {
      const int body = node / 30;
      SurfacePoint<dim> point{node, body, 0.01 * (1 + node % 3), random()};
      point.X[1] += body;
      points.push_back(point);
      x.push_back(point.X);
    }
  }
  Vec<double, dim> random() {
    std::uniform_real_distribution<double> d(0.0, 1.0);
    Vec<double, dim> v;
    for (double& c : v.data) c = d(engine);
    return v;
  }
  void move(double size) {
    for (auto& p : x) p += size * (random() - random());
  }
  [[nodiscard]] double energy_of_all_pairs() const {
    double E = 0.0;
    const auto distance = [](const auto& a, const auto& b) { return std::sqrt(dot(a - b, a - b)); };
    for (const auto& a : points)
      for (const auto& b : points) {
        if (a.node >= b.node) continue;
        const double apart = distance(a.X, b.X), r = distance(x[a.node], x[b.node]);
        if (a.body == b.body && apart <= range) continue;
        E += a.area * b.area * point_repulsion<dim>(r, std::min(range, apart), pressure).value;
      }
    return E;
  }
  std::mt19937 engine{7};
};

template <class T>
class SurfaceContactContract : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SurfaceContactContract, Dimensions);

TYPED_TEST(SurfaceContactContract, NothingRepelsUndeformed) {
  constexpr int dim = TypeParam::value;
  Clouds<dim> clouds;
  SurfaceContact<dim> contact(clouds.points, range, pressure);
  contact.update(clouds.x);
  EXPECT_EQ(contact.totals(clouds.x).energy, 0.0);
}

// The list serves while points move by less than half of its margin, and is made anew beyond.
TYPED_TEST(SurfaceContactContract, ListedPairsHaveTheEnergyOfAllPairs) {
  constexpr int dim = TypeParam::value;
  Clouds<dim> clouds;
  SurfaceContact<dim> contact(clouds.points, range, pressure);
  clouds.move(0.9);
  EXPECT_TRUE(contact.update(clouds.x));
  for (int step = 0; step < 8; ++step) {
    clouds.move(0.05);
    const auto before = contact.pairs();
    const bool changed = contact.update(clouds.x);
    EXPECT_EQ(changed, contact.pairs() != before);
    double E = 0.0;
    for (int k = 0; k < static_cast<int>(contact.pairs().size()); ++k) E += contact.term(k, clouds.x).energy;
    EXPECT_GT(E, 0.0);
    EXPECT_NEAR(E, clouds.energy_of_all_pairs(), 1e-12 * E);
    EXPECT_NEAR(contact.totals(clouds.x).energy, E, 1e-12 * E);
  }
  clouds.move(0.9);
  EXPECT_NEAR(contact.totals(clouds.x).energy, clouds.energy_of_all_pairs(), 1e-9) << "not listed";
}

TYPED_TEST(SurfaceContactContract, ForcesAndTangentsAreDerivativesOfTheEnergy) {
  constexpr int dim = TypeParam::value;
  Clouds<dim> clouds;
  SurfaceContact<dim> contact(clouds.points, range, pressure);
  Vec<double, dim> normal{};
  normal[0] = 0.6, normal[1] = 0.8;
  contact.add_plane({0.1 * normal, normal, false});
  contact.add_plane({0.2 * normal, normal, true});
  clouds.move(0.6);
  contact.update(clouds.x);
  const int n_pairs = static_cast<int>(contact.pairs().size());
  const int n = n_pairs + static_cast<int>(contact.singles().size());
  ASSERT_GT(n, n_pairs + 2);
  constexpr double h = 1e-6;
  int n_active = 0;
  for (int k = 0; k < n; ++k) {
    const int nodes_of_term = k < n_pairs ? 2 : 1;
    const auto node = [&](int a) {
      return nodes_of_term == 2 ? contact.pairs()[k][a] : contact.singles()[k - n_pairs][0];
    };
    const auto term = contact.term(k, clouds.x);
    if (!(term.distance > 0.03)) continue;  // too steep for differences
    n_active += term.energy > 0.0;
    auto momentum = term.R[0] + term.R[1];
    if (nodes_of_term == 2) {
      EXPECT_EQ(dot(momentum, momentum), 0.0);
    }
    for (int b = 0; b < nodes_of_term; ++b)
      for (int j = 0; j < dim; ++j) {
        auto plus = clouds.x, minus = clouds.x;
        plus[node(b)][j] += h, minus[node(b)][j] -= h;
        const auto up = contact.term(k, plus), down = contact.term(k, minus);
        EXPECT_NEAR(term.R[b][j], (up.energy - down.energy) / (2 * h), 1e-6);
        for (int a = 0; a < nodes_of_term; ++a)
          for (int i = 0; i < dim; ++i)
            EXPECT_NEAR(term.K[a * nodes_of_term + b](i, j), (up.R[a][i] - down.R[a][i]) / (2 * h), 2e-5);
      }
  }
  EXPECT_GT(n_active, 10);
}

TEST(SurfaceContact, PlanesHoldBackWhatDoesNotStartNearThem) {
  const std::vector<SurfacePoint<2>> points = {{0, 0, 0.5, {0.0, 1.0}}, {1, 0, 0.5, {1.0, 0.2}}};
  SurfaceContact<2> contact(points, range, pressure);
  contact.add_plane({{0.0, 0.0}, {0.0, 1.0}, false});
  const std::vector<Vec<double, 2>> x = {{0.0, 0.15}, {1.0, 0.1}};
  contact.update(x);
  ASSERT_EQ(contact.singles().size(), 1u);                          // the other one began within the range
  EXPECT_NEAR(contact.term(0, x).R[0][1], -0.5 * pressure, 1e-14);  // half of the range above it
  EXPECT_NEAR(contact.totals(x).gap, 0.15, 1e-15);
}

// Leaflet against leaflet, and against the plane half way between them.
TEST(SurfaceContact, AMirrorPlaneHoldsAsTheImageDoes) {
  SurfaceContact<2> contact({{0, 0, 0.5, {0.0, 1.0}}}, range, pressure);
  contact.add_plane({{0.0, 0.0}, {0.0, 1.0}, true});
  const std::vector<Vec<double, 2>> x = {{0.0, 0.25 * range}};  // the image is half of the range away
  contact.update(x);
  EXPECT_NEAR(contact.term(0, x).R[0][1], -0.5 * pressure, 1e-14);
  EXPECT_NEAR(contact.term(0, x).energy, 0.25 * plane_repulsion(0.5 * range, range, pressure).value, 1e-15);
}
}  // namespace
