/// \file
/// Parser of Gmsh's MSH files. Formats: the Gmsh reference manual, "MSH file format" (4.1) and "MSH file
/// format version 2" (2.2).

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "ifsi/core/error.hpp"
#include "ifsi/mesh/gmsh_file.hpp"

namespace ifsi {

namespace {

/// The text or bytes of a file, read front to back.
class Input {
 public:
  explicit Input(const std::string& path) : path_(path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Error(ExitCode::file, path + ": cannot be opened; expected a readable Gmsh MSH file");
    std::ostringstream content;
    content << in.rdbuf();
    data_ = content.str();
  }

  bool binary = false;  ///< how number() reads from now on

  [[noreturn]] void fail(const std::string& what) const {
    std::string where = path_ + ":";
    if (binary)
      where += " byte " + std::to_string(position_);
    else
      where +=
          std::to_string(1 + std::count(data_.begin(), data_.begin() + static_cast<long>(position_), '\n'));
    throw Error(ExitCode::file, where + ": " + what);
  }

  /// Next word of text; empty at the end of the file.
  std::string word() {
    skip_space();
    const size_t begin = position_;
    while (position_ < data_.size() && !std::isspace(static_cast<unsigned char>(data_[position_])))
      ++position_;
    return data_.substr(begin, position_ - begin);
  }

  /// Rest of the line, its end skipped.
  std::string line() {
    const size_t end = std::min(data_.find('\n', position_), data_.size());
    std::string rest = data_.substr(position_, end - position_);
    position_ = std::min(end + 1, data_.size());
    if (!rest.empty() && rest.back() == '\r') rest.pop_back();
    return rest;
  }

  /// A number in text, whatever the file type.
  template <class T>
  T text_number(const char* what) {
    skip_space();
    T value{};
    const char* begin = data_.data() + position_;
    const char* end = data_.data() + data_.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    const bool whole = stop == end || std::isspace(static_cast<unsigned char>(*stop));
    if (error != std::errc() || !whole) {
      const std::string found = word();
      position_ -= found.size();
      fail(found.empty() ? std::string("the file ends here; expected ") + what
                         : "found \"" + found.substr(0, 40) + "\"; expected " + what);
    }
    position_ += static_cast<size_t>(stop - begin);
    return value;
  }

  /// A number in text or in the bytes of T.
  template <class T>
  T number(const char* what) {
    if (!binary) return text_number<T>(what);
    if (data_.size() - position_ < sizeof(T)) fail(std::string("the file ends here; expected ") + what);
    T value;
    std::memcpy(&value, data_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  /// Checks a count of things that take at least one byte each against what is left of the file.
  template <class T>
  size_t count(T n, const char* what) const {
    if (n < T(0) || static_cast<std::uint64_t>(n) > data_.size() - position_)
      fail("found a count of " + std::to_string(n) + " " + what +
           "; expected no more than the file can hold");
    return static_cast<size_t>(n);
  }

  /// Expects the end mark of a section; or skips to it.
  void end_section(const std::string& name, bool skip = false) {
    const std::string mark = "$End" + name;
    if (skip) {
      const size_t found = data_.find(mark, position_);
      if (found == std::string::npos) fail("the file ends inside section $" + name + "; expected " + mark);
      position_ = found;
    }
    const std::string found = word();
    if (found == mark) return;
    position_ -= found.size();
    fail((found.empty() ? std::string("the file ends here") : "found \"" + found.substr(0, 40) + "\"") +
         "; expected " + mark);
  }

 private:
  void skip_space() {
    while (position_ < data_.size() && std::isspace(static_cast<unsigned char>(data_[position_])))
      ++position_;
  }

  std::string path_;
  std::string data_;
  size_t position_ = 0;
};

/// Reads the sections of one file.
class Parser {
 public:
  explicit Parser(const std::string& path) : in_(path) {}

  GmshFile parse() {
    read_format();
    for (std::string mark = in_.word(); !mark.empty(); mark = in_.word()) {
      if (mark[0] != '$')
        in_.fail("found \"" + mark.substr(0, 40) + "\"; expected the start of a section, $Name");
      in_.line();
      read_section(mark.substr(1));
    }
    if (file_.elements.empty()) in_.fail("the file has no $Elements section; expected one, after $Nodes");
    return std::move(file_);
  }

 private:
  void read_format() {
    const std::string first = in_.word();
    if (first != "$MeshFormat")
      in_.fail("found \"" + first.substr(0, 40) +
               "\"; expected $MeshFormat, the first line of a Gmsh MSH file");
    const auto version = in_.text_number<double>("the format version");
    if (version != 2.2 && version != 4.1)
      in_.fail("found MSH version " + std::to_string(version).substr(0, 3) +
               "; expected 2.2 or 4.1 (write it with gmsh -format msh41)");
    four_ = version == 4.1;
    binary_ = in_.text_number<int>("the file type") == 1;
    const int size = in_.text_number<int>("the data size");
    if (size != 8) in_.fail("found data size " + std::to_string(size) + "; expected 8");
    in_.line();
    in_.binary = binary_;
    if (binary_ && in_.number<int>("the byte order mark") != 1)
      in_.fail("the file was written with another byte order; expected that of this machine");
    in_.end_section("MeshFormat");
    in_.binary = false;
  }

  void read_section(const std::string& name) {
    if (name == "PartitionedEntities") in_.fail("found a partitioned mesh; expected one that is not");
    if (name == "PhysicalNames") {
      read_names();
    } else if (name == "Entities") {
      in_.binary = binary_;
      read_entities();
    } else if (name == "Nodes") {
      four_ ? read_nodes4() : read_nodes2();
    } else if (name == "Elements") {
      four_ ? read_elements4() : read_elements2();
    } else if (name == "Periodic") {
      four_ ? read_periodic4() : read_periodic2();
    } else {
      in_.end_section(name, true);
      return;
    }
    in_.end_section(name);
    in_.binary = false;
  }

  void read_names() {
    const int n = in_.text_number<int>("the number of physical names");
    for (int i = 0; i < n; ++i) {
      const int dim = in_.text_number<int>("the dimension of a physical group");
      const int tag = in_.text_number<int>("the tag of a physical group");
      const std::string rest = in_.line();
      const size_t open = rest.find('"'), close = rest.rfind('"');
      if (open == close) in_.fail("found \"" + rest + "\"; expected the name of a physical group in quotes");
      file_.group_names[{dim, tag}] = rest.substr(open + 1, close - open - 1);
    }
  }

  /// The first physical tag of each entity.
  void read_entities() {
    std::array<std::uint64_t, 4> n;
    for (auto& count : n) count = in_.count(in_.number<std::uint64_t>("the number of entities"), "entities");
    for (int dim = 0; dim < 4; ++dim)
      for (std::uint64_t e = 0; e < n[dim]; ++e) {
        const int tag = in_.number<int>("the tag of an entity");
        for (int k = 0; k < (dim == 0 ? 3 : 6); ++k) in_.number<double>("the extent of an entity");
        const auto groups = in_.number<std::uint64_t>("the number of physical groups of an entity");
        for (std::uint64_t g = 0; g < groups; ++g) {
          const int physical = in_.number<int>("a physical tag");
          if (g == 0) entity_group_[{dim, tag}] = std::abs(physical);
        }
        if (dim == 0) continue;
        const auto bounds = in_.number<std::uint64_t>("the number of bounding entities");
        for (std::uint64_t b = 0; b < bounds; ++b) in_.number<int>("a bounding entity");
      }
  }

  void add_point(std::uint64_t tag) { point_of_tag_[tag] = static_cast<int>(point_of_tag_.size()); }

  Vec<double, 3> read_point() {
    Vec<double, 3> x;
    for (int d = 0; d < 3; ++d) x[d] = in_.number<double>("a coordinate");
    return x;
  }

  int point(std::uint64_t tag) const {
    const auto found = point_of_tag_.find(tag);
    if (found == point_of_tag_.end())
      in_.fail("found node " + std::to_string(tag) + "; expected a node listed in $Nodes");
    return found->second;
  }

  void read_nodes2() {
    const size_t n = in_.count(in_.text_number<long>("the number of nodes"), "nodes");
    in_.line();
    in_.binary = binary_;
    for (size_t i = 0; i < n; ++i) {
      add_point(static_cast<std::uint64_t>(in_.number<int>("the number of a node")));
      file_.points.push_back(read_point());
    }
  }

  void read_nodes4() {
    in_.binary = binary_;
    const size_t blocks = in_.count(in_.number<std::uint64_t>("the number of node blocks"), "node blocks");
    for (int k = 0; k < 3; ++k) in_.number<std::uint64_t>("the number and range of nodes");
    for (size_t b = 0; b < blocks; ++b) {
      const int dim = in_.number<int>("the dimension of an entity");
      in_.number<int>("the tag of an entity");
      const bool parametric = in_.number<int>("whether nodes have parameters") != 0;
      const size_t n = in_.count(in_.number<std::uint64_t>("the number of nodes of a block"), "nodes");
      for (size_t i = 0; i < n; ++i) add_point(in_.number<std::uint64_t>("the number of a node"));
      for (size_t i = 0; i < n; ++i) {
        file_.points.push_back(read_point());
        for (int d = 0; parametric && d < dim; ++d) in_.number<double>("a parameter of a node");
      }
    }
  }

  GmshFile::Elements& elements_of_type(int type, int& n_nodes) {
    n_nodes = gmsh_type(type).n_nodes;
    if (n_nodes == 0)
      in_.fail("found element type " + std::to_string(type) + "; expected one that ifsi knows");
    return file_.elements[type];
  }

  void read_elements2() {
    const size_t n = in_.count(in_.text_number<long>("the number of elements"), "elements");
    in_.line();
    in_.binary = binary_;
    for (size_t done = 0; done < n;) {
      if (!binary_) in_.number<int>("the number of an element");
      const int type = in_.number<int>("an element type");
      const size_t follow = binary_ ? in_.count(in_.number<int>("a number of elements"), "elements") : 1;
      const int tags = in_.number<int>("the number of tags of an element");
      int n_nodes;
      auto& elements = elements_of_type(type, n_nodes);
      for (size_t i = 0; i < follow; ++i) read_element2(elements, tags, n_nodes);
      done += std::max<size_t>(follow, 1);
    }
  }

  void read_element2(GmshFile::Elements& elements, int tags, int n_nodes) {
    if (binary_) in_.number<int>("the number of an element");
    int physical = 0;
    for (int t = 0; t < tags; ++t) {
      const int tag = in_.number<int>("a tag of an element");
      if (t == 0) physical = std::abs(tag);
    }
    elements.physical.push_back(physical);
    for (int a = 0; a < n_nodes; ++a)
      elements.points.push_back(point(static_cast<std::uint64_t>(in_.number<int>("a node of an element"))));
  }

  void read_elements4() {
    in_.binary = binary_;
    const size_t blocks =
        in_.count(in_.number<std::uint64_t>("the number of element blocks"), "element blocks");
    for (int k = 0; k < 3; ++k) in_.number<std::uint64_t>("the number and range of elements");
    for (size_t b = 0; b < blocks; ++b) {
      const int dim = in_.number<int>("the dimension of an entity");
      const int entity = in_.number<int>("the tag of an entity");
      const auto group = entity_group_.find({dim, entity});
      int n_nodes;
      auto& elements = elements_of_type(in_.number<int>("an element type"), n_nodes);
      const size_t n = in_.count(in_.number<std::uint64_t>("the number of elements of a block"), "elements");
      for (size_t i = 0; i < n; ++i) {
        in_.number<std::uint64_t>("the number of an element");
        elements.physical.push_back(group == entity_group_.end() ? 0 : group->second);
        for (int a = 0; a < n_nodes; ++a)
          elements.points.push_back(point(in_.number<std::uint64_t>("a node of an element")));
      }
    }
  }

  /// Version 2.2 writes this section as text, in binary files too.
  void read_periodic2() {
    const int links = in_.text_number<int>("the number of periodic entities");
    for (int l = 0; l < links; ++l) {
      for (int k = 0; k < 3; ++k) in_.text_number<int>("a periodic entity");
      in_.line();
      std::string next = in_.line();
      if (next.rfind("Affine", 0) == 0) next = in_.line();
      const int n = std::atoi(next.c_str());
      for (int i = 0; i < n; ++i) {
        const int copy = point(in_.text_number<std::uint64_t>("a periodic node"));
        file_.periodic.push_back({copy, point(in_.text_number<std::uint64_t>("a periodic node"))});
      }
    }
  }

  void read_periodic4() {
    in_.binary = binary_;
    const auto links = in_.number<std::uint64_t>("the number of periodic entities");
    for (std::uint64_t l = 0; l < links; ++l) {
      for (int k = 0; k < 3; ++k) in_.number<int>("a periodic entity");
      const auto n_affine = in_.number<std::uint64_t>("the size of an affine map");
      for (std::uint64_t k = 0; k < n_affine; ++k) in_.number<double>("an entry of an affine map");
      const auto n = in_.number<std::uint64_t>("the number of periodic nodes");
      for (std::uint64_t i = 0; i < n; ++i) {
        const int copy = point(in_.number<std::uint64_t>("a periodic node"));
        file_.periodic.push_back({copy, point(in_.number<std::uint64_t>("a periodic node"))});
      }
    }
  }

  Input in_;
  bool four_ = false;  ///< version 4.1, else 2.2
  bool binary_ = false;
  GmshFile file_;
  std::unordered_map<std::uint64_t, int> point_of_tag_;
  std::map<std::pair<int, int>, int> entity_group_;
};

}  // namespace

GmshType gmsh_type(int type) {
  static const std::map<int, GmshType> types = {
      {15, {0, 1, "point"}},
      {1, {1, 2, "line of 2 nodes"}},
      {8, {1, 3, "line of 3 nodes"}},
      {26, {1, 4, "line of 4 nodes"}},
      {2, {2, 3, "triangle of 3 nodes"}},
      {9, {2, 6, "triangle of 6 nodes"}},
      {21, {2, 10, "triangle of 10 nodes"}},
      {3, {2, 4, "quadrangle of 4 nodes"}},
      {16, {2, 8, "quadrangle of 8 nodes (Mesh.SecondOrderIncomplete = 0 makes 9)"}},
      {10, {2, 9, "quadrangle of 9 nodes"}},
      {36, {2, 16, "quadrangle of 16 nodes"}},
      {4, {3, 4, "tetrahedron of 4 nodes"}},
      {11, {3, 10, "tetrahedron of 10 nodes"}},
      {29, {3, 20, "tetrahedron of 20 nodes"}},
      {5, {3, 8, "hexahedron of 8 nodes"}},
      {17, {3, 20, "hexahedron of 20 nodes (Mesh.SecondOrderIncomplete = 0 makes 27)"}},
      {12, {3, 27, "hexahedron of 27 nodes"}},
      {6, {3, 6, "prism of 6 nodes"}},
      {18, {3, 15, "prism of 15 nodes"}},
      {13, {3, 18, "prism of 18 nodes"}},
      {7, {3, 5, "pyramid of 5 nodes"}},
      {19, {3, 13, "pyramid of 13 nodes"}},
      {14, {3, 14, "pyramid of 14 nodes"}}};
  const auto found = types.find(type);
  return found == types.end() ? GmshType{-1, 0, "unknown"} : found->second;
}

GmshFile read_gmsh_file(const std::string& path) { return Parser(path).parse(); }

}  // namespace ifsi
