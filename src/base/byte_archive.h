// Values as bytes in memory's own form, for a reader that is the same program: between processes, and on disk.
//
// A type's visit(archive, value), found beside the type, names its fields once; the archive writes or reads them.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace plumbline {

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
/// A type that can be copied as bytes. The caller makes sure that it holds no pointers.
template <class T>
concept Copyable = std::is_trivially_copyable_v<T>;

class ByteWriter {
 public:
  template <Plain T>
  void operator()(T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(std::string& text) {
    std::size_t size = text.size();
    (*this)(size);
    bytes_ += text;
  }
  /// The elements' number, then all elements in one block.
  template <Copyable T>
  void block(std::vector<T>& items) {
    count(items);
    bytes_.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
  }
  void word(const char*& text) {
    std::string copy = text;
    (*this)(copy);
  }
  template <class T>
  std::size_t count(T& items) {
    std::size_t size = items.size();
    (*this)(size);
    return size;
  }
  template <class T>
  bool has(std::optional<T>& value) {
    bool there = value.has_value();
    (*this)(there);
    return there;
  }
  std::string done() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Throws std::runtime_error where the bytes end too early. Bytes that no ByteWriter wrote are read without a check.
class ByteReader {
 public:
  /// `words` owns the texts that word() reads; null where no value has one.
  ByteReader(std::string_view bytes, std::set<std::string>* words) : bytes_(bytes), words_(words) {}
  template <Plain T>
  void operator()(T& value) {
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  void operator()(std::string& text) {
    std::size_t size = 0;
    (*this)(size);
    text.assign(take(size), size);
  }
  template <Copyable T>
  void block(std::vector<T>& items) {
    const std::size_t size = count(items);
    if (size > bytes_.size() / sizeof(T)) throw std::runtime_error("bytes are cut off");
    items.resize(size);
    if (size > 0) std::memcpy(static_cast<void*>(items.data()), take(size * sizeof(T)), size * sizeof(T));
  }
  void word(const char*& text) {
    std::string read;
    (*this)(read);
    text = words_->insert(std::move(read)).first->c_str();
  }
  template <class T>
  std::size_t count(T&) {
    std::size_t size = 0;
    (*this)(size);
    return size;
  }
  template <class T>
  bool has(std::optional<T>& value) {
    bool there = false;
    (*this)(there);
    if (there) value.emplace();
    return there;
  }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size()) throw std::runtime_error("bytes are cut off");
    const char* out = bytes_.data();
    bytes_.remove_prefix(size);
    return out;
  }

  std::string_view bytes_;
  std::set<std::string>* words_;
};

template <class T>
concept PlainOrText = Plain<T> || std::same_as<T, std::string>;
template <class Archive, PlainOrText T>
void visit(Archive& archive, T& value) {
  archive(value);
}
template <class Archive, class T>
void visit(Archive& archive, std::vector<T>& items) {
  items.resize(archive.count(items));
  for (T& item : items) visit(archive, item);
}
template <class Archive, class K, class V>
void visit(Archive& archive, std::map<K, V>& items) {
  std::vector<std::pair<K, V>> list(items.begin(), items.end());
  list.resize(archive.count(list));
  for (auto& [key, value] : list) {
    visit(archive, key);
    visit(archive, value);
  }
  items = std::map<K, V>(list.begin(), list.end());
}
/// Each of the fields, in this order.
template <class Archive, class... Fields>
void visit_all(Archive& archive, Fields&... fields) {
  (visit(archive, fields), ...);
}

}  // namespace plumbline
