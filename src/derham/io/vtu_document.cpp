#include "derham/io/vtu_document.hpp"

#include "derham/core/text.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace derham {
namespace {

using pugi::xml_node;

std::size_t trimmed_size(std::string_view bytes) {
  return bytes.find_last_not_of(" \t\r\n\f\v") + 1;  // npos + 1 is 0
}

// Behind the tag, comment or the like that begins at `begin`.
std::size_t markup_end(std::string_view xml, std::size_t begin) {
  const auto behind = [&](std::string_view end) {
    const auto at = xml.find(end, begin);
    return at == std::string_view::npos ? xml.size() : at + end.size();
  };
  const auto rest = xml.substr(begin);
  if (rest.starts_with("<!--")) return behind("-->");
  if (rest.starts_with("<![CDATA[")) return behind("]]>");
  if (rest.starts_with("<?")) return behind("?>");
  char quote = '\0';
  for (auto at = begin; at < xml.size(); ++at) {
    const char c = xml[at];
    if (quote != '\0')
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '>')
      return at + 1;
  }
  return xml.size();
}

}  // namespace

VtuDocument::VtuDocument(Cursor& file) : file_(file) {
  file_.rewind(0);
  whole_ = file_.bytes(file_.remaining(), "the file");
  const auto head = cut_appended();
  constexpr std::ptrdiff_t most_tags = 1'000'000;
  if (std::ranges::count(head, '<') > most_tags)
    fail_at(0, text("the file has more than ", most_tags, " elements; expected few, with long arrays"));
  copy_markup(head);
  if (head.size() < whole_.size()) xml_ += "</AppendedData></VTKFile>";
  const auto result = document_.load_buffer_inplace(xml_.data(), xml_.size(), pugi::parse_escapes, pugi::encoding_utf8);
  if (!result) fail_at(file_offset(result.offset), text("not well-formed XML: ", result.description()));
}

// Appended data are no XML: what stands before them is parsed, closed by ourselves.
std::string_view VtuDocument::cut_appended() {
  auto end = trimmed_size(whole_);
  const auto drop = [&](std::string_view tag) {
    if (!whole_.substr(0, end).ends_with(tag)) fail_at(end, text("the file does not end with ", tag));
    end -= tag.size();
  };
  drop("</VTKFile>");
  const auto tag = whole_.find("<AppendedData");
  const auto tag_end = whole_.find('>', tag);
  if (tag_end == std::string_view::npos || whole_[tag_end - 1] == '/') return whole_;
  end = trimmed_size(whole_.substr(0, end));
  drop("</AppendedData>");  // the bytes before it are data, also where they look like blanks
  const auto begin = whole_.find_first_not_of(" \t\r\n", tag_end + 1);
  if (begin == std::string_view::npos || begin >= end || whole_[begin] != '_')
    fail_at(tag_end, "the appended data do not begin with an underscore");
  appended_ = whole_.substr(begin + 1, end - begin - 1);
  return whole_.substr(0, tag_end + 1);
}

void VtuDocument::copy_markup(std::string_view xml) {
  const auto copy = [&](std::size_t begin, std::string_view piece) {
    pieces_.push_back({xml_.size(), begin});
    xml_ += piece;
  };
  for (std::size_t at = 0; at < xml.size();) {
    const auto tag = std::min(xml.find('<', at), xml.size());
    if (xml.substr(at, tag - at).find_first_not_of(" \t\r\n") != std::string_view::npos) copy(at, "x");
    at = markup_end(xml, tag);
    copy(tag, xml.substr(tag, at - tag));
  }
}

std::size_t VtuDocument::file_offset(std::ptrdiff_t xml_offset) const noexcept {
  const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(xml_offset, 0));
  const auto behind = std::ranges::upper_bound(pieces_, offset, {}, &Piece::in_xml);
  if (behind == pieces_.begin()) return 0;
  const auto& piece = *std::prev(behind);
  return std::min(piece.in_file + (offset - piece.in_xml), whole_.size());
}

std::string_view VtuDocument::text_of(const xml_node& node) const {
  for (const auto child : node.children())
    if (child.type() == pugi::node_pcdata) {
      const auto begin = file_offset(child.offset_debug());
      return whole_.substr(begin, whole_.find('<', begin) - begin);
    }
  return whole_.substr(file_offset(node.offset_debug()), 0);
}

std::int64_t VtuDocument::number(const xml_node& node, const char* name, std::int64_t usual) const {
  const auto attribute = node.attribute(name);
  const std::string_view digits = attribute.value();
  if (!attribute && usual >= 0) return usual;
  std::int64_t value = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || value < 0)
    fail_at(node, text(name, " is ", quoted_token(digits), ", expected a number that is not negative"));
  return value;
}

xml_node VtuDocument::only_child(const xml_node& parent, const char* name) const {
  const auto child = parent.child(name);
  if (!child) fail_at(parent, text("the piece has no element ", name));
  if (const auto second = child.next_sibling(name)) fail_at(second, text("a second element ", name));
  return child;
}

void VtuDocument::stand_at(const xml_node& node) const {
  file_.rewind(static_cast<std::int64_t>(file_offset(node.offset_debug())));
}

void VtuDocument::fail_at(const xml_node& node, const std::string& message) const {
  stand_at(node);
  file_.fail(message);
}

void VtuDocument::fail_at(std::size_t offset, const std::string& message) const {
  file_.rewind(static_cast<std::int64_t>(std::min(offset, whole_.size())));
  file_.fail(message);
}

}  // namespace derham
