#include "model/thin_layers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "fpm/bodies.hpp"
#include "model/given_interface.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

// Particles of each body.
std::vector<fpm::Index> sizes_of(const std::vector<fpm::Index>& body) {
  std::vector<fpm::Index> sizes(static_cast<std::size_t>(std::ranges::max(body)) + 1, 0);
  for (const fpm::Index b : body) ++sizes[static_cast<std::size_t>(b)];
  return sizes;
}

// Refuses what the scene itself gives between two materials that are of one body.
template <int Dim>
void require_unsaid(const scene::Scene& scene, const ThinLayer<Dim>& thin, bool is_thin) {
  const auto key =
      key_of_given(scene, {std::min(thin.layer, thin.beside), std::max(thin.layer, thin.beside)});
  if (!key) return;
  const std::string& layer = scene.material[static_cast<std::size_t>(thin.layer)].name;
  const std::string& beside = scene.material[static_cast<std::size_t>(thin.beside)].name;
  const std::string place =
      fmt::format("{:.4g}", fmt::join(thin.place.begin(), thin.place.end(), ", "));
  throw InterfaceRefused(
      *key,
      is_thin ? fmt::format("\"{}\" is less than three particles thick at ({}) m, too thin for "
                            "rows of its own beside \"{}\"",
                            layer, place, beside)
              : fmt::format("\"{}\" and \"{}\", which meet at ({}) m, are of one body with a "
                            "layer less than three particles thick that meets both",
                            layer, beside, place),
      "allowed are \"through\", or finer particles");
}

}  // namespace

template <int Dim>
void note_thin_layers(const scene::Scene& scene, const std::vector<fpm::Index>& apart,
                      fpm::Index fewest, Model<Dim>& model) {
  const std::vector<fpm::Index>& body = model.particles.body;
  const std::vector<fpm::Index> sizes = sizes_of(apart);
  const std::vector<bool> thin = fpm::thin_bodies(model.cells, apart, fewest);
  std::set<std::pair<fpm::Index, fpm::Index>> seen;
  const auto visit = [&](fpm::Index a, fpm::Index b) {
    const auto of = [](const auto& list, fpm::Index k) {
      return list[static_cast<std::size_t>(k)];
    };
    const bool is_one = body.empty() || of(body, a) == of(body, b);
    if (of(apart, a) == of(apart, b) || !is_one) return;
    // The thin one first; of two that of fewer particles.
    const bool first = of(thin, of(apart, a)), second = of(thin, of(apart, b));
    const bool is_larger = of(sizes, of(apart, a)) > of(sizes, of(apart, b));
    if (first == second ? is_larger : second) std::swap(a, b);
    const auto layer = static_cast<fpm::Index>(of(model.material, a));
    const auto beside = static_cast<fpm::Index>(of(model.material, b));
    if (layer == beside || !seen.insert(std::minmax(layer, beside)).second) return;
    const ThinLayer<Dim> found{layer, beside, model.particles.position.row(a).transpose()};
    require_unsaid(scene, found, first || second);
    // What only a thin layer between them joins is said of that.
    if (first || second) model.thin_layers.push_back(found);
  };
  model.cells.for_each_pair([&](fpm::Index a, fpm::Index b, int /*axis*/) { visit(a, b); });
  for (const auto& [a, b] : model.meeting) visit(a, b);
}

template void note_thin_layers<2>(const scene::Scene&, const std::vector<fpm::Index>&, fpm::Index,
                                  Model<2>&);
template void note_thin_layers<3>(const scene::Scene&, const std::vector<fpm::Index>&, fpm::Index,
                                  Model<3>&);

}  // namespace model
