#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "picture/picture.hpp"
#include "run/drawing.hpp"
#include "run/drawing_style.hpp"
#include "run/solid_tiles.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace run {
namespace {

using Place = Eigen::Vector3d;
using Colour = Eigen::Vector3d;  // red, green, blue of 255

constexpr double view_width = 460.0, view_height = 520.0;  // [px] the most that a body takes

Colour colour_of(std::string_view code) {
  const auto part = [&](std::size_t i) {
    return static_cast<double>(std::stoi(std::string(code.substr(1 + 2 * i, 2)), nullptr, 16));
  };
  return {part(0), part(1), part(2)};
}

class SolidDrawing {
 public:
  SolidDrawing(const scene::Scene& scene, const model::Model<3>& model,
               const std::vector<std::string>& notes)
      : scene_(scene),
        model_(model),
        notes_(notes),
        tiles_(tiles_of(scene, model)),
        conditions_(conditions_of(scene, model, tiles_)) {}

  std::string text() {
    const std::array<Place, 2> towards{Place(0.5, 0.55, 0.8), Place(-0.5, -0.55, -0.8)};
    constexpr std::array<std::string_view, 2> captions{
        "from above, the right and the back (greatest z)",
        "from below, the left and the front (least z)"};
    scale_ = std::min(view_width / extent(towards[0], 0), view_height / extent(towards[0], 1));
    const double height = scale_ * extent(towards[0], 1);
    middle_y_ = drawing_margin + 0.5 * height;
    for (std::size_t i = 0; i < 2; ++i) {
      look_from(towards[i]);
      middle_x_ = drawing_margin + 0.5 * view_width +
                  (view_width + 0.5 * drawing_margin) * static_cast<double>(i);
      add_tiles();
      label(middle_x_, 24.0, "#404040", captions[i]);
      add_axes(height);
    }
    add_legend(height);
    const double width = 2.0 * view_width + 2.5 * drawing_margin;
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
               "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
               "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
               width, below_ + drawing_margin / 2.0) +
           out_ + "</svg>\n";
  }

 private:
  void look_from(const Place& towards) {
    towards_ = towards.normalized();
    right_ = Place::UnitY().cross(towards_).normalized();
    up_ = towards_.cross(right_);
  }

  // [m] Of the box, across or up the picture.
  double extent(const Place& towards, int which) {
    look_from(towards);
    const Place along = which == 0 ? right_ : up_;
    return along.cwiseAbs().dot(model_.box_max - model_.box_min);
  }

  [[nodiscard]] double x(const Place& at) const {
    return middle_x_ + scale_ * right_.dot(at - 0.5 * (model_.box_min + model_.box_max));
  }
  [[nodiscard]] double y(const Place& at) const {
    return middle_y_ - scale_ * up_.dot(at - 0.5 * (model_.box_min + model_.box_max));
  }

  void label(double x, double y, std::string_view colour, std::string_view text) {
    fmt::format_to(std::back_inserter(out_),
                   "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\" text-anchor=\"middle\" "
                   "paint-order=\"stroke\" stroke=\"white\" stroke-width=\"3\">{}</text>\n",
                   x, y + 4.0, colour, picture::escaped(text));
  }

  // What is further away first, so that what is nearer hides it.
  void add_tiles() {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (tiles_[i].outward.dot(towards_) > 1e-6) order.push_back(i);
    }
    // Nothing is in front of the end of a prism.
    const auto key = [&](std::size_t i) {
      return std::pair(is_end(tiles_[i]), towards_.dot(tiles_[i].middle));
    };
    std::ranges::stable_sort(order, {}, key);
    std::vector<std::pair<Place, double>> centre(conditions_.size(), {Place::Zero(), 0.0});
    bool has_ends = false;
    for (const std::size_t i : order) {
      const Tile& tile = tiles_[i];
      if (is_end(tile) && !has_ends) add_ends(tile);
      has_ends = has_ends || is_end(tile);
      for (std::size_t c = 0; c < conditions_.size(); ++c) {
        if (!conditions_[c].is_of(tile)) continue;
        const double area = tile.edges[0].cross(tile.edges[1]).norm();
        centre[c].first += area * tile.middle;
        centre[c].second += area;
      }
      const double spacing = model_.spacing_at(tile.particle);
      constexpr double same = 1e-6;
      const bool is_cut = std::abs(tile.edges[0].norm() - spacing) > same * spacing ||
                          std::abs(tile.edges[1].norm() - spacing) > same * spacing;
      if (is_end(tile) && is_cut) continue;  // the region shows it
      add_tile(tile, colour_at(tile, model_.material[static_cast<std::size_t>(tile.particle)]));
    }
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      if (centre[c].second == 0.0) continue;
      const Place at = centre[c].first / centre[c].second;
      label(x(at), y(at), conditions_[c].colour, conditions_[c].name);
    }
  }

  [[nodiscard]] bool is_end(const Tile& tile) const {
    return scene::is_extruded(scene_) && tile.face >= static_cast<int>(scene::Side::front);
  }

  // Of its material and of what acts there.
  [[nodiscard]] Colour colour_at(const Tile& tile, std::size_t material) const {
    Colour colour = colour_of(material_colours[material % material_colours.size()]);
    constexpr double share = 0.45;  // of the condition's colour
    for (const Condition& condition : conditions_) {
      if (!condition.is_of(tile)) continue;
      colour = (1.0 - share) * colour + share * colour_of(condition.colour);
    }
    const Place light = Place(0.15, 0.9, 0.4).normalized();
    return (0.86 + 0.14 * tile.outward.dot(light)) * colour;
  }

  // Regions at the end of a prism, whole; cells that outlines cut have no rectangle for a tile.
  void add_ends(Tile end) {
    const double z = end.middle.z();
    end.middle.setConstant(std::numeric_limits<double>::infinity());  // in no range
    end.particle = -1;
    for (std::size_t r = 0; r < scene_.region.size(); ++r) {
      const scene::Region& region = scene_.region[r];
      if (!region.present) continue;
      std::string path;
      const auto add_ring = [&](const std::vector<scene::PlanePoint>& ring) {
        for (const scene::PlanePoint& point : ring) {
          const Place at(point.x(), point.y(), z);
          path += fmt::format("{}{:.1f} {:.1f}", &point == ring.data() ? "M" : "L", x(at), y(at));
        }
        path += "Z";
      };
      add_ring(region.outline);
      for (const auto& hole : region.holes) add_ring(hole);
      fmt::format_to(std::back_inserter(out_), "<path d=\"{}\" fill-rule=\"evenodd\" {}/>\n", path,
                     paint(colour_at(end, scene::material_of(scene_, r))));
    }
  }

  static std::string paint(const Colour& colour) {
    const auto code = [](const Colour& c) {
      return fmt::format("#{:02x}{:02x}{:02x}", int(c[0]), int(c[1]), int(c[2]));
    };
    return fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"0.6\"", code(colour),
                       code(0.85 * colour));
  }

  void add_tile(const Tile& tile, const Colour& colour) {
    std::vector<Place> corners = tile.corners;
    if (corners.empty()) {
      const Place first = 0.5 * tile.edges[0], second = 0.5 * tile.edges[1];
      corners = {tile.middle - first - second, tile.middle + first - second,
                 tile.middle + first + second, tile.middle - first + second};
    }
    out_ += "<polygon points=\"";
    for (const Place& at : corners) {
      fmt::format_to(std::back_inserter(out_), "{:.1f},{:.1f} ", x(at), y(at));
    }
    out_ += "\" " + paint(colour) + "/>\n";
  }

  void add_axes(double height) {
    constexpr double length = 26.0;  // [px]
    const double at_x = middle_x_ - 0.5 * view_width + 10.0;
    const double at_y = drawing_margin + height + 20.0;
    constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
      const double to_x = at_x + length * right_[axis], to_y = at_y - length * up_[axis];
      fmt::format_to(std::back_inserter(out_),
                     "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
                     "stroke=\"#404040\"/>\n",
                     at_x, at_y, to_x, to_y);
      label(at_x + 1.3 * (to_x - at_x), at_y + 1.3 * (to_y - at_y), "#404040",
            names[static_cast<std::size_t>(axis)]);
    }
  }

  void written(std::string_view colour, const std::string& text) {
    below_ += drawing_line_height;
    fmt::format_to(std::back_inserter(out_),
                   "<rect x=\"{0:.0f}\" y=\"{1:.0f}\" width=\"10\" height=\"10\" fill=\"{2}\"/>"
                   "<text x=\"{3:.0f}\" y=\"{4:.0f}\">{5}</text>\n",
                   drawing_margin, below_ - 10.0, colour, drawing_margin + 16.0, below_,
                   picture::escaped(text));
  }

  void add_legend(double height) {
    below_ = height + 2.0 * drawing_margin;
    double widest = 0.0;
    for (Eigen::Index a = 0; a < model_.size(); ++a)
      widest = std::max(widest, model_.spacing_at(a));
    std::string spacing = fmt::format("{:g}", model_.spacing);
    if (widest > model_.spacing) spacing += fmt::format(" to {:g}", widest);
    const Place size = model_.box_max - model_.box_min;
    written("white", fmt::format("{}{} particles, {} m apart, {:g} x {:g} x {:g} m",
                                 scene_.title.empty() ? "" : scene_.title + ": ", model_.size(),
                                 spacing, size.x(), size.y(), size.z()));
    for (const std::string& note : notes_) written("white", note);
    for (std::size_t m = 0; m < scene_.material.size(); ++m) {
      const scene::Material& material = scene_.material[m];
      written(material_colours[m % material_colours.size()],
              fmt::format("{}: {}", material.name, material.model));
    }
    for (const Condition& condition : conditions_) {
      written(condition.colour, condition.name + ": " + condition.text);
    }
  }

  const scene::Scene& scene_;
  const model::Model<3>& model_;
  const std::vector<std::string>& notes_;
  std::vector<Tile> tiles_;
  std::vector<Condition> conditions_;
  Place towards_ = Place::UnitZ(), right_ = Place::UnitX(), up_ = Place::UnitY();
  double scale_ = 1.0, middle_x_ = 0.0, middle_y_ = 0.0, below_ = 0.0;  // [px/m], [px]
  std::string out_;
};

}  // namespace

std::string drawing_of(const scene::Scene& scene, const model::Model<3>& model,
                       const std::vector<std::string>& notes) {
  return SolidDrawing(scene, model, notes).text();
}

}  // namespace run
