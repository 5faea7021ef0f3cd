#pragma once
/// \file
/// VTK output: unstructured grids (.vtu, one per rank joined by a .pvtu) and their series in time (.pvd).
/// Data are appended raw binary, compressed with zlib in blocks.

#include <string>
#include <vector>

#include "ifsi/core/communicator.hpp"

namespace ifsi {

/// A field over the points or the cells of a grid.
struct VtuField {
  std::string name, unit;
  int components;              ///< values per point or cell
  std::vector<double> values;  ///< [entry * components + component]
};

/// An unstructured grid with its fields: what one rank writes.
struct VtuPiece {
  std::vector<double> points;        ///< x, y, z of each point
  std::vector<long> connectivity;    ///< points of the cells, in VTK's node order
  std::vector<long> offsets;         ///< end of each cell in connectivity
  std::vector<unsigned char> types;  ///< VTK cell types
  std::vector<VtuField> point_fields, cell_fields;
};

/// Size of the numbers in a file; computations are in double whatever this is.
enum class VtuPrecision { single_precision, double_precision };

/// Throws Error(file) when the file cannot be written, std::logic_error when array sizes do not agree.
void write_vtu(const std::string& file, const VtuPiece& piece, VtuPrecision precision);
/// Joins pieces (paths relative to this file) that have the fields of `like`.
void write_pvtu(const std::string& file, const std::vector<std::string>& pieces, const VtuPiece& like,
                VtuPrecision precision);

/// Grids over time: `<folder>/<name>.pvd` names `<name>_<frame>.vtu`, or .pvtu and a .vtu per rank.
class VtuSeries {
 public:
  VtuSeries(Communicator comm, std::string folder, std::string name,
            VtuPrecision precision = VtuPrecision::single_precision);
  /// Restart: keeps the frames of an earlier run up to `time`.
  void resume(double time);
  /// Collective. Each rank hands over its cells, with the same list of fields.
  void write(double time, const VtuPiece& piece);

 private:
  struct Frame {
    double time;
    std::string file;
  };
  void write_index() const;
  Communicator comm_;
  std::string folder_, name_;
  VtuPrecision precision_;
  std::vector<Frame> frames_;
};

}  // namespace ifsi
