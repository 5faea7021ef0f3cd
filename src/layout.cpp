#include "ifsi/linalg/layout.hpp"

#include <string>
#include <utility>

#include "ifsi/core/error.hpp"

namespace ifsi {
namespace {

constexpr int tag = 7101;

}  // namespace

Layout::Layout(Communicator comm, int n_owned, std::vector<long> ghost_global)
    : comm_(comm), n_owned_(n_owned), ghost_global_(std::move(ghost_global)) {
  for (int n : comm_.all_gather(std::vector<int>{n_owned})) first_.push_back(first_.back() + n);
  check_ghosts();
  find_owners();
}

void Layout::check_ghosts() const {
  std::string wrong;
  for (long g : ghost_global_)
    if (g < 0 || g >= n_global() || owner(g) == comm_.rank()) wrong = std::to_string(g);
  if (!comm_.any(!wrong.empty())) return;
  throw Error(ExitCode::configuration, "Layout: ghost number " +
                                           (wrong.empty() ? "(on another rank)" : wrong) +
                                           " is not owned by another rank; expected numbers in [0, " +
                                           std::to_string(n_global()) + ") outside those of this rank");
}

void Layout::find_owners() {
  const int n_ranks = comm_.size();
  std::vector<std::vector<long>> wanted(n_ranks);
  std::vector<std::vector<int>> place(n_ranks);
  for (int g = 0; g < n_ghost(); ++g) {
    const int rank = owner(ghost_global_[g]);
    wanted[rank].push_back(ghost_global_[g]);
    place[rank].push_back(n_owned_ + g);
  }
  std::vector<int> n_wanted(n_ranks), n_asked(n_ranks);
  for (int r = 0; r < n_ranks; ++r) n_wanted[r] = static_cast<int>(wanted[r].size());
  MPI_Alltoall(n_wanted.data(), 1, MPI_INT, n_asked.data(), 1, MPI_INT, comm_.handle());
  std::vector<std::vector<long>> asked(n_ranks);
  std::vector<MPI_Request> requests;
  for (int r = 0; r < n_ranks; ++r) {
    asked[r].resize(n_asked[r]);
    if (n_asked[r] > 0)
      MPI_Irecv(asked[r].data(), n_asked[r], MPI_LONG, r, tag, comm_.handle(), &requests.emplace_back());
    if (n_wanted[r] > 0)
      MPI_Isend(wanted[r].data(), n_wanted[r], MPI_LONG, r, tag, comm_.handle(), &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (int r = 0; r < n_ranks; ++r) {
    if (n_wanted[r] > 0) receive_.push_back({r, place[r]});
    if (n_asked[r] == 0) continue;
    Neighbour& to = send_.emplace_back(Neighbour{r, {}});
    for (long g : asked[r]) to.indices.push_back(static_cast<int>(g - first_global()));
  }
}

std::vector<std::byte> Layout::transfer(const void* x, std::size_t size, const std::vector<Neighbour>& to,
                                        const std::vector<Neighbour>& from) const {
  const auto total = [size](const std::vector<Neighbour>& neighbours) {
    std::size_t bytes = 0;
    for (const Neighbour& n : neighbours) bytes += n.indices.size() * size;
    return bytes;
  };
  std::vector<std::byte> out(total(to)), in(total(from));
  std::vector<MPI_Request> requests;
  requests.reserve(to.size() + from.size());
  std::byte* place = in.data();
  for (const Neighbour& n : from) {
    const std::size_t bytes = n.indices.size() * size;
    MPI_Irecv(place, static_cast<int>(bytes), MPI_BYTE, n.rank, tag, comm_.handle(),
              &requests.emplace_back());
    place += bytes;
  }
  const auto* entries = static_cast<const std::byte*>(x);
  place = out.data();
  for (const Neighbour& n : to) {
    const std::byte* first = place;
    for (int i : n.indices) {
      std::memcpy(place, entries + static_cast<std::size_t>(i) * size, size);
      place += size;
    }
    MPI_Isend(first, static_cast<int>(place - first), MPI_BYTE, n.rank, tag, comm_.handle(),
              &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return in;
}

}  // namespace ifsi
