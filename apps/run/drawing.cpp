#include "run/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include "picture/picture.hpp"
#include "run/drawing_style.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

namespace run {
namespace {

using Place = Eigen::Vector2d;

constexpr double longest = 900.0;  // [px] of the body
constexpr double margin = drawing_margin, line_height = drawing_line_height;
constexpr auto& colours = material_colours;
constexpr std::string_view held = held_colour, loaded = loaded_colour, moved = moved_colour;

class Drawing {
 public:
  Drawing(const scene::Scene& scene, const model::Model<2>& model,
          const std::vector<std::string>& notes)
      : scene_(scene), model_(model), notes_(notes) {
    const Place size = model.box_max - model.box_min;
    scale_ = longest / size.maxCoeff();
    height_ = scale_ * size.y();
    width_ = scale_ * size.x();
  }

  std::string text() {
    add_particles();
    add_outline();
    for (const model::JointPiece<2>& joint : model_.joints) line(joint.from, joint.to, held, 0.7);
    for (const scene::OutlineSide& side : scene_.side) add_side(side);
    for (const scene::Cutout& cutout : scene_.cutout) add_cutout(cutout);
    for (const scene::Support& support : scene_.support) add_support(support);
    for (const scene::Symmetry& mirror : scene_.symmetry) add_mirror(mirror);
    for (const scene::Traction& traction : scene_.traction) {
      on_face(
          traction.side, position_of(traction.side), traction.range_min, traction.range_max, loaded,
          fmt::format("{} ({:g}, {:g}) Pa", traction.name, traction.value[0], traction.value[1]));
    }
    add_drive();
    add_legend();
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
               "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
               "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
               width_ + 2.0 * margin, below_ + margin / 2.0) +
           out_ + "</svg>\n";
  }

 private:
  [[nodiscard]] double x(const Place& at) const {
    return margin + scale_ * (at.x() - model_.box_min.x());
  }
  [[nodiscard]] double y(const Place& at) const {
    return margin + scale_ * (model_.box_max.y() - at.y());
  }

  void line(const Place& from, const Place& to, std::string_view colour, double width) {
    fmt::format_to(std::back_inserter(out_),
                   "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
                   "stroke-width=\"{}\"/>\n",
                   x(from), y(from), x(to), y(to), colour, width);
  }

  void label(const Place& at, std::string_view colour, const std::string& text) {
    fmt::format_to(std::back_inserter(out_),
                   "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\" text-anchor=\"middle\" "
                   "paint-order=\"stroke\" stroke=\"white\" stroke-width=\"3\">{}</text>\n",
                   x(at), y(at) + 4.0, colour, picture::escaped(text));
  }

  void written_line(const Place& from, const Place& to, std::string_view colour,
                    const std::string& text) {
    line(from, to, colour, 3.0);
    label(0.5 * (from + to), colour, text);
  }

  void add_particles() {
    for (Eigen::Index a = 0; a < model_.size(); ++a) {
      const Place at = model_.particles.position.row(a).transpose();
      const double across = 0.8 * scale_ * std::sqrt(model_.particles.volume[a]);
      const auto material = model_.material[static_cast<std::size_t>(a)];
      fmt::format_to(std::back_inserter(out_),
                     "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\"/>\n", x(at),
                     y(at), 0.5 * across, colours[material % colours.size()]);
    }
  }

  void add_outline() {
    for (const model::SurfacePiece<2>& piece : model_.surface)
      line(piece.from, piece.to, held, 1.0);
    if (!model_.surface.empty()) return;
    fmt::format_to(std::back_inserter(out_),
                   "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
                   "fill=\"none\" stroke=\"{}\"/>\n",
                   margin, margin, width_, height_, held);
  }

  void add_side(const scene::OutlineSide& side) {
    using scene::OutlineKind;
    if (side.kind == OutlineKind::free) return;
    const std::string_view colour = side.kind == OutlineKind::loaded    ? loaded
                                    : side.kind == OutlineKind::footing ? moved
                                                                        : held;
    std::size_t longest_piece = 0;
    const auto at = [&](std::size_t i) { return Place(side.along[i].x(), side.along[i].y()); };
    for (std::size_t i = 0; i + 1 < side.along.size(); ++i) {
      line(at(i), at(i + 1), colour, 3.0);
      if ((at(i + 1) - at(i)).norm() > (at(longest_piece + 1) - at(longest_piece)).norm()) {
        longest_piece = i;
      }
    }
    std::string text = fmt::format("{}: {}", side.name, scene::name_of(side.kind));
    if (side.pressure != 0.0) text += fmt::format(" {:g} Pa", side.pressure);
    if (side.live_pressure != 0.0) text += fmt::format(" up to {:g} Pa", side.live_pressure);
    label(0.5 * (at(longest_piece) + at(longest_piece + 1)), colour, text);
  }

  void add_cutout(const scene::Cutout& cutout) {
    const auto index = static_cast<int>(&cutout - scene_.cutout.data());
    const bool is_loaded = cutout.pressure != 0.0 || cutout.shear != 0.0;
    const std::string_view colour = is_loaded ? loaded : held;
    for (const model::SurfacePiece<2>& piece : model_.surface) {
      if (piece.cut != index) continue;
      if (is_loaded || cutout.kind != scene::CutoutKind::free) {
        line(piece.from, piece.to, colour, 3.0);
      }
    }
    const auto first = std::ranges::find(model_.surface, index, &model::SurfacePiece<2>::cut);
    if (first == model_.surface.end()) return;
    std::string text = fmt::format("{}: {}", cutout.name, scene::name_of(cutout.kind));
    if (cutout.pressure != 0.0) text += fmt::format(" {:g} Pa", cutout.pressure);
    label(first->from, colour, text);
  }

  double position_of(scene::Side side) const { return scene::side_position(scene_.geometry, side); }

  // A part of a face of the box, or of one parallel to it.
  void on_face(scene::Side side, double position, const scene::Point& range_min,
               const scene::Point& range_max, std::string_view colour, const std::string& text) {
    const int across = scene::axis_of(side), along = 1 - across;
    Place from = model_.box_min, to = model_.box_max;
    from[across] = to[across] = position;
    if (!range_min.empty()) from[along] = range_min[0];
    if (!range_max.empty()) to[along] = range_max[0];
    written_line(from, to, colour, text);
  }

  void add_support(const scene::Support& support) {
    const bool is_of_side = std::ranges::any_of(scene_.side, [&](const scene::OutlineSide& side) {
      return support.name.starts_with(side.name);
    });
    if (is_of_side) return;
    std::string text = support.name + ":";
    for (const scene::Axis axis : support.directions) {
      text += fmt::format(" {}", scene::name_of(axis));
    }
    if (support.side) {
      on_face(*support.side, position_of(*support.side), {}, {}, held, text);
    } else if (!support.at.empty()) {
      label(Place(support.at[0], support.at[1]), held, text);
    } else {
      label(0.5 * Place(support.region_min[0] + support.region_max[0],
                        support.region_min[1] + support.region_max[1]),
            held, text);
    }
  }

  void add_mirror(const scene::Symmetry& mirror) {
    if (!scene_.side.empty()) return;
    const int axis = static_cast<int>(mirror.axis);
    const bool upper = mirror.position > 0.5 * (model_.box_min[axis] + model_.box_max[axis]);
    const auto side = static_cast<scene::Side>(2 * axis + (upper ? 1 : 0));
    on_face(side, position_of(side), {}, {}, held, "symmetry");
  }

  void add_drive() {
    for (const scene::NamedDrive& named : scene::drives_of(scene_)) {
      const scene::Drive& drive = *named.drive;
      const bool displaces = drive.kind == scene::DriveKind::displacement;
      if (!displaces && !scene::loads_plate(drive)) continue;
      on_face(drive.side, scene::plate_position(scene_.geometry, drive), drive.range_min,
              drive.range_max, moved,
              displaces ? fmt::format("moved by {:g} m", drive.target) : "loaded plate");
    }
  }

  void written(std::string_view colour, const std::string& text) {
    below_ += line_height;
    fmt::format_to(std::back_inserter(out_),
                   "<rect x=\"{0:.0f}\" y=\"{1:.0f}\" width=\"10\" height=\"10\" fill=\"{2}\"/>"
                   "<text x=\"{3:.0f}\" y=\"{4:.0f}\">{5}</text>\n",
                   margin, below_ - 10.0, colour, margin + 16.0, below_, picture::escaped(text));
  }

  void add_legend() {
    below_ = height_ + 1.5 * margin;
    double widest = 0.0;
    for (Eigen::Index a = 0; a < model_.size(); ++a)
      widest = std::max(widest, model_.spacing_at(a));
    std::string spacing = fmt::format("{:g}", model_.spacing);
    if (widest > model_.spacing) spacing += fmt::format(" to {:g}", widest);
    written("white", fmt::format("{}{} particles, {} m apart, {:g} x {:g} m",
                                 scene_.title.empty() ? "" : scene_.title + ": ", model_.size(),
                                 spacing, model_.box_max.x() - model_.box_min.x(),
                                 model_.box_max.y() - model_.box_min.y()));
    for (const std::string& note : notes_) written("white", note);
    for (std::size_t m = 0; m < scene_.material.size(); ++m) {
      const scene::Material& material = scene_.material[m];
      written(colours[m % colours.size()], fmt::format("{}: {}", material.name, material.model));
    }
  }

  const scene::Scene& scene_;
  const model::Model<2>& model_;
  const std::vector<std::string>& notes_;
  double scale_ = 1.0, width_ = 0.0, height_ = 0.0, below_ = 0.0;
  std::string out_;
};

}  // namespace

std::string drawing_of(const scene::Scene& scene, const model::Model<2>& model,
                       const std::vector<std::string>& notes) {
  return Drawing(scene, model, notes).text();
}

}  // namespace run
