// Layout against the definition: every entry has one owner, ghosts see it, sums return to it.
#include <gtest/gtest.h>

#include "ifsi/core/error.hpp"
#include "ifsi/linalg/layout.hpp"

namespace {
using namespace ifsi;

/// A ring of 5 + rank indices per rank; each rank sees two indices of each neighbour and one far away.
struct Ring {
  Communicator comm;
  Layout layout;
  std::vector<long> ghosts;
  Ring() {
    std::vector<long> first{0};
    for (int r = 0; r < comm.size(); ++r) first.push_back(first.back() + 5 + r);
    const long n = first.back(), a = first[comm.rank()], b = first[comm.rank() + 1];
    for (long g : {(b + 1) % n, b % n, (a + n - 1) % n, (a + n - 2) % n, (b + 4) % n})
      if ((g < a || g >= b) && std::find(ghosts.begin(), ghosts.end(), g) == ghosts.end())
        ghosts.push_back(g);
    layout = Layout(comm, 5 + comm.rank(), ghosts);
  }
};

TEST(Layout, CountsAndGlobalNumbers) {
  Ring ring;
  const Layout& l = ring.layout;
  const int n_ranks = ring.comm.size();
  EXPECT_EQ(l.n_global(), 5 * n_ranks + n_ranks * (n_ranks - 1) / 2);
  EXPECT_EQ(l.n_local(), l.n_owned() + static_cast<int>(ring.ghosts.size()));
  for (int i = 0; i < l.n_owned(); ++i) {
    EXPECT_EQ(l.global(i), l.first_global() + i);
    EXPECT_EQ(l.owner(l.global(i)), ring.comm.rank());
  }
  for (int g = 0; g < l.n_ghost(); ++g) {
    EXPECT_EQ(l.global(l.n_owned() + g), ring.ghosts[g]);
    EXPECT_NE(l.owner(ring.ghosts[g]), ring.comm.rank());
  }
}

TEST(Layout, GhostsSeeTheirOwners) {
  Ring ring;
  const Layout& l = ring.layout;
  std::vector<double> x(l.n_local() * 3, -1.0);
  for (int i = 0; i < l.n_owned(); ++i)
    for (int c = 0; c < 3; ++c) x[3 * i + c] = 10.0 * l.global(i) + c;
  l.update_ghosts(x.data(), 3);
  for (int i = 0; i < l.n_local(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(x[3 * i + c], 10.0 * l.global(i) + c);
}

TEST(Layout, AddingToOwnersIsTheTransposeOfUpdatingGhosts) {
  Ring ring;
  const Layout& l = ring.layout;
  std::vector<double> x(l.n_local()), y(l.n_local());
  for (int i = 0; i < l.n_owned(); ++i) x[i] = 1.0 + 0.3 * l.global(i);
  for (int i = 0; i < l.n_local(); ++i) y[i] = 2.0 - 0.1 * i * (ring.comm.rank() + 1);
  std::vector<double> Px = x, Pty = y;
  l.update_ghosts(Px.data());
  l.add_to_owners(Pty.data());
  double Px_y = 0;
  for (int i = 0; i < l.n_local(); ++i) Px_y += Px[i] * y[i];
  EXPECT_NEAR(ring.comm.sum(Px_y), l.dot(x.data(), Pty.data()), 1e-12);
}

TEST(Layout, RefusesGhostsThatNobodyElseOwns) {
  const Communicator comm;
  EXPECT_THROW(Layout(comm, 4, {comm.rank() * 4L}), Error);
  EXPECT_THROW(
      Layout(comm, 4, {comm.rank() == 0 ? 4L * comm.size() : (comm.rank() * 4L + 4) % (4L * comm.size())}),
      Error);
}
}  // namespace
