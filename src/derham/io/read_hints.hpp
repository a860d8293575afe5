#pragma once

// What readers say of the options of ReadOptions that would let them take a file: for those who call the library and for
// those at the command line.
namespace derham {

inline constexpr const char* split_on_reading = "split on reading (--triangulate, ReadOptions::triangulate)";
inline constexpr const char* keep_corner_nodes =
    "keep only the corner nodes (--corner-nodes, ReadOptions::corner_nodes)";

}  // namespace derham
