#pragma once

#include <sstream>
#include <string>

#include "fpm/types.hpp"

namespace fpm {

// Numbers and places as messages have them.
inline std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

template <int Dim>
std::string text_of(const Eigen::Matrix<double, 1, Dim>& place) {
  std::string text = "(";
  for (int i = 0; i < Dim; ++i) text += (i > 0 ? ", " : "") + text_of(place[i]);
  return text + ")";
}

}  // namespace fpm
