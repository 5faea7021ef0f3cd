#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "atomic_file.hpp"
#include "ifsi/io/root.hpp"
#include "ifsi/io/vtu.hpp"

namespace ifsi {
namespace {

/// The value of an XML attribute in a line of our own .pvd, "" when it is not there.
std::string attribute(const std::string& line, const std::string& name) {
  const std::size_t start = line.find(name + "=\"");
  if (start == std::string::npos) return "";
  const std::size_t from = start + name.size() + 2;
  return line.substr(from, line.find('"', from) - from);
}

}  // namespace

VtuSeries::VtuSeries(Communicator comm, std::string folder, std::string name, VtuPrecision precision)
    : comm_(comm), folder_(std::move(folder)), name_(std::move(name)), precision_(precision) {}

void VtuSeries::resume(double time) {
  frames_.clear();
  std::ifstream index(folder_ + "/" + name_ + ".pvd");
  for (std::string line; std::getline(index, line);) {
    const std::string file = attribute(line, "file");
    if (file.empty()) continue;
    const double at = std::strtod(attribute(line, "timestep").c_str(), nullptr);
    if (at <= time + 1e-9 * std::abs(time)) frames_.push_back({at, file});
  }
}

void VtuSeries::write(double time, const VtuPiece& piece) {
  const std::string frame = fmt::format("{}_{:06}", name_, frames_.size());
  const bool alone = comm_.size() == 1;
  const auto piece_name = [&](int rank) {
    return alone ? frame + ".vtu" : fmt::format("{}_{:04}.vtu", frame, rank);
  };
  write_vtu(folder_ + "/" + piece_name(comm_.rank()), piece, precision_);
  frames_.push_back({time, alone ? frame + ".vtu" : frame + ".pvtu"});
  on_root(comm_, [&] {
    std::vector<std::string> pieces;
    for (int r = 0; r < comm_.size(); ++r) pieces.push_back(piece_name(r));
    if (!alone) write_pvtu(folder_ + "/" + frames_.back().file, pieces, piece, precision_);
    write_index();
  });
}

void VtuSeries::write_index() const {
  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (const Frame& f : frames_)
    xml += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", f.time, f.file);
  detail::write_atomically(folder_ + "/" + name_ + ".pvd", xml + "</Collection>\n</VTKFile>\n");
}

}  // namespace ifsi
