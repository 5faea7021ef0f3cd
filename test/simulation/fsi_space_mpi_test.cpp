// Immersed solids in space: hexes, wedges and tetrahedra move alike in the same fluid, on any number of
// ranks.
#include <gtest/gtest.h>

#include "duct.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/fsi_problem.hpp"

namespace ifsi {
namespace {

struct PostEnd {
  Vec<double, 3> u;
  double volume_change, violation;
};

/// A soft post that stands on the floor of a duct, after some steps: how far the middle of its free end has
/// gone.
template <class Element>
PostEnd bent_post(Communicator comm) {
  using Body = SolidBody<Element, NeoHookean>;
  const auto mesh = distribute(box<Hex1>({0.0, 0.0, 0.0}, {2.0, 1.0, 1.0}, {6, 5, 4}), comm);
  std::vector<Body> post;
  post.emplace_back("post", box<Element>({0.8, 0.0, 0.3}, {1.2, 0.6, 0.7}, {2, 3, 2}),
                    NeoHookean(Lame::from_young(50.0, 0.3)),
                    SolidParameters<3>{.rho_s = 1.2, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}});
  FlowOptions flow;
  flow.rho_inf = 0.0, flow.newton.rtol = 1e-10;
  FsiProblem<Hex1, Body> problem(mesh, test::duct(), 1.0, Newtonian{0.1}, std::move(post), flow,
                                 FsiOptions{});
  const auto X = problem.solids().positions();
  for (int k = 0; k < 2; ++k) EXPECT_TRUE(problem.step(0.05).converged);
  for (int a = 0; a < problem.solids().n_nodes(); ++a)
    if (std::abs(X[a][0] - 1.0) + std::abs(X[a][1] - 0.6) + std::abs(X[a][2] - 0.5) < 1e-12)
      return {problem.solids().displacement(a), problem.solids().totals().volume / (0.4 * 0.6 * 0.4) - 1.0,
              problem.constraint_violation()};
  ADD_FAILURE() << "no node in the middle of the free end";
  return {};
}

template <class Element>
class PostInSpace : public testing::Test {};
using PostElements = testing::Types<Hex1, Wedge1, Tet1>;
TYPED_TEST_SUITE(PostInSpace, PostElements);

TYPED_TEST(PostInSpace, BendsAsOneOfHexesDoes) {
  const PostEnd hexes = bent_post<Hex1>(Communicator(MPI_COMM_SELF));
  const PostEnd post = bent_post<TypeParam>(Communicator(MPI_COMM_SELF));
  EXPECT_GT(hexes.u[0], 0.01);
  EXPECT_NEAR(post.u[0], hexes.u[0], 0.05 * hexes.u[0]);
  EXPECT_LT(std::abs(post.volume_change), 0.01);
  EXPECT_LT(post.violation, 1e-10);
}

TYPED_TEST(PostInSpace, DoesNotDependOnTheRanks) {
  const PostEnd alone = bent_post<TypeParam>(Communicator(MPI_COMM_SELF)),
                shared = bent_post<TypeParam>(Communicator());
  EXPECT_LT(shared.violation, 1e-10);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(shared.u[d], alone.u[d], 1e-9);
}

}  // namespace
}  // namespace ifsi
