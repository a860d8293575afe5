#pragma once

#include "derham/io/cursor.hpp"
#include "derham/io/npy.hpp"
#include "derham/io/zip_read.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// The arrays of a .npz file. Not installed.
namespace derham {

/// The arrays of an archive by their names, each read when it is asked for.
class NpzArrays {
 public:
  /// Reads the directory of the archive. Throws FileError.
  explicit NpzArrays(Cursor& file);

  [[nodiscard]] bool contains(std::string_view name) const { return arrays_.contains(name); }
  /// The arrays that were not asked for yet, in the order of the file; and the entries that are no arrays.
  [[nodiscard]] std::vector<std::string_view> unused() const;
  [[nodiscard]] std::vector<std::string_view> others() const;

  /// Calls action(array, fail) if there is an array of that name; `fail` names it in its FileError.
  template <class Action>
  void with(std::string_view name, Action action) {
    const auto found = arrays_.find(name);
    if (found == arrays_.end()) return;
    const auto& entry = *found->second;
    used_.insert(found->first);
    std::unique_ptr<char[]> unpacked;
    const NpyFail fail_here = [&](const std::string& message) { fail(entry, message); };
    action(parse_npy(archive_.contents(entry, unpacked), fail_here), fail_here);
  }

  /// FileError about the whole archive.
  [[noreturn]] void fail(const std::string& message) { archive_.fail(0, message); }

 private:
  [[noreturn]] void fail(const ZipArchive::Entry& entry, const std::string& message);

  ZipArchive archive_;
  std::map<std::string_view, const ZipArchive::Entry*> arrays_;
  std::set<std::string_view> used_;
};

/// The numbers of an array, all finite if so demanded.
[[nodiscard]] std::vector<double> npz_reals(const NpyArray& array, bool finite, const NpyFail& fail);

/// Entry i of an array of texts, as UTF-8 if it is Unicode.
[[nodiscard]] std::string npz_text(const NpyArray& array, std::size_t i, const NpyFail& fail);

void require_integers(const NpyArray& array, const NpyFail& fail);
void require_shape(const NpyArray& array, const std::vector<std::int64_t>& shape, const char* why, const NpyFail& fail);

}  // namespace derham
