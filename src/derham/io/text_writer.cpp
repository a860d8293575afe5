#include "derham/io/text_writer.hpp"

#include "derham/core/cancel.hpp"

#include <algorithm>

namespace derham {

TextWriter& TextWriter::put(std::string_view bytes) {
  if (used_ + bytes.size() > capacity) flush();
  if (bytes.size() > capacity) {
    file_.write(bytes);
    return *this;
  }
  std::ranges::copy(bytes, &buffer_[used_]);
  used_ += bytes.size();
  return *this;
}

void TextWriter::flush() {
  poll_cancel();
  file_.write({buffer_.get(), used_});
  used_ = 0;
}

}  // namespace derham
