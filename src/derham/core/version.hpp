#pragma once

namespace derham {

/// The version of the library, as "major.minor.patch".
inline constexpr const char* version = "0.1.0";

}  // namespace derham
