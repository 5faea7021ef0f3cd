#include "ifsi/io/vtu.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <stdexcept>

#include "ifsi/core/error.hpp"

namespace ifsi {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 17;
// On smooth fields level 1 gives files some 10 % larger than level 6 in a fifth of the time.
constexpr int compression_level = 1;
constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

const char* real_type(VtuPrecision p) { return p == VtuPrecision::single_precision ? "Float32" : "Float64"; }

std::string file_head(const char* type) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" "
      "header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n",
      type, byte_order);
}

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

/// One array as VTK stores it: number of blocks, block size, size of a last partial block, compressed sizes;
/// blocks.
void append_compressed(std::string& bytes, const void* data, std::size_t size) {
  const std::size_t n_blocks = (size + block_bytes - 1) / block_bytes;
  std::vector<std::uint64_t> header{n_blocks, block_bytes, size % block_bytes};
  std::string blocks;
  std::vector<Bytef> block(compressBound(block_bytes));
  for (std::size_t start = 0; start < size; start += block_bytes) {
    uLongf packed = block.size();
    const auto* from = static_cast<const Bytef*>(data) + start;
    if (compress2(block.data(), &packed, from, std::min(block_bytes, size - start), compression_level) !=
        Z_OK)
      throw std::bad_alloc();
    append(blocks, block.data(), packed);
    header.push_back(packed);
  }
  append(bytes, header.data(), header.size() * sizeof(std::uint64_t));
  bytes += blocks;
}

/// The XML part and the appended data of a file, filled array by array.
struct Document {
  VtuPrecision precision;
  std::string xml, data;

  template <class T>
  void array(const char* type, const std::string& name, int components, const std::vector<T>& values) {
    xml += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        type, name, components, data.size());
    append_compressed(data, values.data(), values.size() * sizeof(T));
  }
  void reals(const std::string& name, int components, const std::vector<double>& values) {
    if (precision == VtuPrecision::double_precision)
      return array(real_type(precision), name, components, values);
    array(real_type(precision), name, components, std::vector<float>(values.begin(), values.end()));
  }
  void fields(const char* section, const std::vector<VtuField>& list) {
    xml += fmt::format("<{}>\n", section);
    for (const VtuField& f : list) {
      xml += fmt::format("<!-- {} [{}] -->\n", f.name, f.unit);
      reals(f.name, f.components, f.values);
    }
    xml += fmt::format("</{}>\n", section);
  }
};

void require_size(const std::vector<VtuField>& fields, std::size_t entries) {
  for (const VtuField& f : fields)
    if (f.values.size() != entries * static_cast<std::size_t>(f.components))
      throw std::logic_error(fmt::format("VTU field '{}' has {} values; expected {} x {}", f.name,
                                         f.values.size(), entries, f.components));
}

void write_file(const std::string& file, const std::string& bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream << bytes << std::flush;
  if (!stream) throw Error(ExitCode::file, "cannot write '" + file + "' (is the disk full?)");
}

std::string parallel_fields(const char* section, const std::vector<VtuField>& list, VtuPrecision precision) {
  std::string xml = fmt::format("<{}>\n", section);
  for (const VtuField& f : list)
    xml += fmt::format("<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n",
                       real_type(precision), f.name, f.components);
  return xml + fmt::format("</{}>\n", section);
}

}  // namespace

void write_vtu(const std::string& file, const VtuPiece& piece, VtuPrecision precision) {
  const std::size_t n_points = piece.points.size() / 3, n_cells = piece.types.size();
  require_size(piece.point_fields, n_points);
  require_size(piece.cell_fields, n_cells);
  Document d{precision, "", ""};
  d.fields("PointData", piece.point_fields);
  d.fields("CellData", piece.cell_fields);
  d.xml += "<Points>\n";
  d.reals("Points", 3, piece.points);
  d.xml += "</Points>\n<Cells>\n";
  d.array("Int64", "connectivity", 1, piece.connectivity);
  d.array("Int64", "offsets", 1, piece.offsets);
  d.array("UInt8", "types", 1, piece.types);
  d.xml += "</Cells>\n";
  write_file(file, file_head("UnstructuredGrid") +
                       fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                                   n_points, n_cells) +
                       d.xml + "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" + d.data +
                       "\n</AppendedData>\n</VTKFile>\n");
}

void write_pvtu(const std::string& file, const std::vector<std::string>& pieces, const VtuPiece& like,
                VtuPrecision precision) {
  std::string xml = file_head("PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n";
  xml += parallel_fields("PPointData", like.point_fields, precision);
  xml += parallel_fields("PCellData", like.cell_fields, precision);
  xml += fmt::format(
      "<PPoints>\n<PDataArray type=\"{}\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n",
      real_type(precision));
  for (const std::string& piece : pieces) xml += fmt::format("<Piece Source=\"{}\"/>\n", piece);
  write_file(file, xml + "</PUnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace ifsi
