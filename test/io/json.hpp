#pragma once
/// \file
/// A strict reader of JSON, to check what ifsi writes.

#include <cctype>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ifsi::test {

/// A JSON value; which member counts follows from `kind`.
struct Json {
  enum class Kind { null, boolean, number, string, array, object } kind = Kind::null;
  bool boolean = false;
  double number = 0.0;
  std::string string{};
  std::vector<std::pair<std::string, Json>> members{};  // of objects in order; of arrays with empty names

  const Json& operator[](const std::string& name) const {
    for (const auto& [key, value] : members)
      if (key == name) return value;
    throw std::runtime_error("JSON: no member " + name);
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& member : members) list.push_back(member.first);
    return list;
  }
};

class JsonReader {
 public:
  explicit JsonReader(std::string text) : text_(std::move(text)) {}
  /// Throws std::runtime_error for anything that is not exactly one JSON value.
  Json read() {
    Json value = next();
    skip_space();
    if (at_ != text_.size()) fail();
    return value;
  }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error("JSON: unexpected text at " + text_.substr(at_, 40));
  }
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(const std::string& word) {
    skip_space();
    if (text_.compare(at_, word.size(), word) != 0) return false;
    at_ += word.size();
    return true;
  }
  void expect(const std::string& word) {
    if (!take(word)) fail();
  }
  Json next() {
    skip_space();
    if (take("null")) return {};
    if (take("true")) return {Json::Kind::boolean, true};
    if (take("false")) return {Json::Kind::boolean, false};
    if (take("{")) return sequence(Json::Kind::object, "}");
    if (take("[")) return sequence(Json::Kind::array, "]");
    if (text_[at_] == '"') return {Json::Kind::string, false, 0.0, string()};
    return number();
  }
  Json number() {
    if (text_[at_] != '-' && !std::isdigit(static_cast<unsigned char>(text_[at_]))) fail();  // no nan, no inf
    char* end = nullptr;
    const double x = std::strtod(text_.c_str() + at_, &end);
    at_ = static_cast<std::size_t>(end - text_.c_str());
    return {Json::Kind::number, false, x};
  }
  std::string string() {
    expect("\"");
    std::string value;
    for (; text_.at(at_) != '"'; ++at_) {
      if (static_cast<unsigned char>(text_[at_]) < 0x20) fail();
      if (text_[at_] == '\\')
        value += escape();
      else
        value += text_[at_];
    }
    ++at_;
    return value;
  }
  char escape() {
    const char c = text_.at(++at_);
    if (c == 'n') return '\n';
    if (c == 't') return '\t';
    if (c != 'u') return c;
    at_ += 4;
    return static_cast<char>(std::strtol(text_.substr(at_ - 3, 4).c_str(), nullptr, 16));
  }
  Json sequence(Json::Kind kind, const std::string& end) {
    Json list{kind};
    if (take(end)) return list;
    do {
      std::string name;
      if (kind == Json::Kind::object) {
        skip_space();
        name = string();
        expect(":");
      }
      list.members.emplace_back(name, next());
    } while (take(","));
    expect(end);
    return list;
  }

  std::string text_;
  std::size_t at_ = 0;
};

inline Json read_json(const std::string& text) { return JsonReader(text).read(); }

}  // namespace ifsi::test
