// Uses a header and a compiled part of ifsi, under MPI.
#include <iostream>

#include "ifsi/core/communicator.hpp"
#include "ifsi/core/suggestion.hpp"
#include "ifsi/core/tensor.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const double ranks = ifsi::Communicator().sum(1.0);
  MPI_Finalize();
  const bool ok = ranks == 1.0 && ifsi::det(ifsi::Mat<double, 3>::identity()) == 1.0 &&
                  ifsi::nearest_name("velocty", {"pressure", "velocity"}) == "velocity";
  std::cout << (ok ? "consumer: ok\n" : "consumer: wrong\n");
  return ok ? 0 : 1;
}
