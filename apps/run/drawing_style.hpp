#pragma once

#include <array>
#include <string_view>

namespace run {

// What pictures of plane scenes and of bodies in space have in common.
inline constexpr double drawing_margin = 60.0;  // [px]
inline constexpr double drawing_line_height = 18.0;
inline constexpr std::array<std::string_view, 8> material_colours{
    "#d9b382", "#8fb0c9", "#a8c98f", "#c99bb8", "#c9c38f", "#9f9fd0", "#d09f8f", "#8fc9c0"};
inline constexpr std::string_view held_colour = "#202020", loaded_colour = "#c03020",
                                  moved_colour = "#2050c0";

}  // namespace run
