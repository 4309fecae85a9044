// The only file that sees CGAL, whose two-dimensional meshes are under the GPL (see the document).
#include "limit/ground/ground_mesh.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace limit::ground {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

Kernel::Point_2 exact(const mesh::Point& place) {
  return {place.x(), place.y()};
}

mesh::Point place_of(const Kernel::Point_2& exact) {
  return {exact.x(), exact.y()};
}

class Mesher {
 public:
  Mesher(const GroundScene& scene, const GroundOutline& outline, const GroundFineness& fineness)
      : scene_(scene),
        outline_(outline),
        longest_(fineness.longest),
        fans_(ground_fans(scene, outline, fineness)) {
    for (std::size_t r = 0; r < outline.regions.size(); ++r) {
      regions_.push_back(outline.rings(r));
    }
  }

  mesh::Mesh mesh() {
    constrain();
    refine();
    for (auto face : triangulation_.finite_face_handles()) {
      if (face->is_in_domain()) add_face(face);
    }
    for (const GroundFan& fan : fans_) add_fan(fan);
    return std::move(mesh_);
  }

 private:
  // Where a segment begins and ends, outside the fans at its ends.
  [[nodiscard]] std::pair<mesh::Point, mesh::Point> outside_fans(
      const GroundSegment& segment) const {
    mesh::Point first = outline_.at(segment.first), second = outline_.at(segment.second);
    const mesh::Point along = (second - first).normalized();
    for (const GroundFan& fan : fans_) {
      if (fan.centre == segment.first) first = rim(fan, along);
      if (fan.centre == segment.second) second = rim(fan, -along);
    }
    return {first, second};
  }

  // Exactly the fan's own point on that ray.
  [[nodiscard]] mesh::Point rim(const GroundFan& fan, const mesh::Point& direction) const {
    const auto ray = std::max_element(fan.directions.begin(), fan.directions.end(),
                                      [&](const mesh::Point& a, const mesh::Point& b) {
                                        return a.dot(direction) < b.dot(direction);
                                      }) -
                     fan.directions.begin();
    return fan.at(outline_, static_cast<std::size_t>(ray), fan.radii.size() - 1);
  }

  void constrain() {
    for (const GroundSegment& segment : outline_.segments) {
      const auto [first, second] = outside_fans(segment);
      triangulation_.insert_constraint(exact(first), exact(second));
    }
    for (const GroundFan& fan : fans_) {
      const std::size_t rim = fan.radii.size() - 1;
      for (std::size_t ray = 0; ray + 1 < fan.directions.size(); ++ray) {
        triangulation_.insert_constraint(exact(fan.at(outline_, ray, rim)),
                                         exact(fan.at(outline_, ray + 1, rim)));
      }
    }
  }

  // The region that holds a place outside the fans, or -1.
  [[nodiscard]] int region_at(const mesh::Point& place) const {
    for (const GroundFan& fan : fans_) {
      std::vector<mesh::Point> polygon{outline_.at(fan.centre)};
      for (std::size_t ray = 0; ray < fan.directions.size(); ++ray) {
        polygon.push_back(fan.at(outline_, ray, fan.radii.size() - 1));
      }
      if (is_inside(polygon, place)) return -1;
    }
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      if (is_inside(regions_[r], place)) return static_cast<int>(r);
    }
    return -1;
  }

  [[nodiscard]] static mesh::Point centre_of(Triangulation::Face_handle face) {
    mesh::Point centre(0, 0);
    for (int i = 0; i < 3; ++i) centre += place_of(face->vertex(i)->point()) / 3.0;
    return centre;
  }

  void refine() {
    std::vector<Kernel::Point_2> outside;
    for (auto face : triangulation_.finite_face_handles()) {
      const mesh::Point centre = centre_of(face);
      if (region_at(centre) < 0) outside.push_back(exact(centre));
    }
    // Sine squared of the least angle, 20.7 degrees: what is known to end.
    constexpr double sharpest = 0.125;
    CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation_,
                                                            Criteria(sharpest, longest_));
    mesher.set_seeds(outside.begin(), outside.end(), false);
    mesher.init();
    while (mesher.step_by_step_refine_mesh()) {
      if (triangulation_.number_of_faces() > most_first_triangles) throw too_fine();
    }
  }

  // With the place of the smallest triangle.
  [[nodiscard]] GroundTooFine too_fine() const {
    GroundTooFine narrow;
    double least = std::numeric_limits<double>::infinity();
    for (auto face : triangulation_.finite_face_handles()) {
      const double area = triangulation_.triangle(face).area();
      const int region = region_at(centre_of(face));
      if (region < 0 || area >= least) continue;
      least = area;
      narrow.region = static_cast<std::size_t>(region);
      narrow.place = centre_of(face);
    }
    return narrow;
  }

  int node_at(const mesh::Point& place) {
    const auto [at, is_new] =
        nodes_.emplace(std::pair(place.x(), place.y()), static_cast<int>(mesh_.nodes.size()));
    if (is_new) mesh_.nodes.push_back(place);
    return at->second;
  }

  [[nodiscard]] int material_of(int region) const {
    return static_cast<int>(scene_.regions[static_cast<std::size_t>(region)].material);
  }

  void add_face(Triangulation::Face_handle face) {
    const int region = region_at(centre_of(face));
    if (region < 0) throw std::runtime_error("ground mesh: a triangle outside all regions");
    mesh::Triangle triangle;
    triangle.region = material_of(region);
    for (int i = 0; i < 3; ++i) {
      triangle.nodes[static_cast<std::size_t>(i)] = node_at(place_of(face->vertex(i)->point()));
    }
    mesh_.triangles.push_back(triangle);
    for (int i = 0; i < 3; ++i) {
      if (!face->is_constrained(i) || face->neighbor(i)->is_in_domain()) continue;
      const mesh::Point first = place_of(face->vertex((i + 1) % 3)->point());
      const mesh::Point second = place_of(face->vertex((i + 2) % 3)->point());
      if (const int side = side_at((first + second) / 2.0); side >= 0) {
        mesh_.boundary.push_back({node_at(first), node_at(second), side});
      }
    }
  }

  // The side of the outline that holds a place; -1 on the rim of a fan.
  [[nodiscard]] int side_at(const mesh::Point& place) const {
    for (const GroundSegment& segment : outline_.segments) {
      if (segment.right >= 0) continue;
      const double away = distance(place, outline_.at(segment.first), outline_.at(segment.second));
      if (away <= outline_.tolerance()) return segment.side;
    }
    return -1;
  }

  // The rim's nodes from one ray to the next, with those that the refinement put between them.
  std::vector<int> rim_nodes(const mesh::Point& first, const mesh::Point& second) {
    std::vector<std::pair<double, int>> found;
    for (auto vertex : triangulation_.finite_vertex_handles()) {
      const mesh::Point place = place_of(vertex->point());
      if (distance(place, first, second) > outline_.tolerance()) continue;
      found.emplace_back((place - first).norm(), node_at(place));
    }
    std::sort(found.begin(), found.end());
    std::vector<int> nodes;
    for (const auto& [along, node] : found) nodes.push_back(node);
    return nodes;
  }

  void add_fan(const GroundFan& fan) {
    const int centre = node_at(outline_.at(fan.centre));
    const std::size_t rings = fan.radii.size();
    const auto node = [&](std::size_t ray, std::size_t ring) {
      return ring == 0 ? centre : node_at(fan.at(outline_, ray, ring - 1));
    };
    for (std::size_t ray = 0; ray + 1 < fan.directions.size(); ++ray) {
      const int material = material_of(fan.regions[ray]);
      const auto add = [&](int a, int b, int c) {
        mesh_.triangles.push_back({{a, b, c}, material});
      };
      for (std::size_t ring = 0; ring < rings; ++ring) {
        const std::vector<int> outer =
            ring + 1 < rings
                ? std::vector{node(ray, ring + 1), node(ray + 1, ring + 1)}
                : rim_nodes(fan.at(outline_, ray, ring), fan.at(outline_, ray + 1, ring));
        for (std::size_t i = 0; i + 1 < outer.size(); ++i) {
          add(node(ray, ring), outer[i], outer[i + 1]);
        }
        if (ring > 0) add(node(ray, ring), outer.back(), node(ray + 1, ring));
      }
    }
    const std::size_t last = fan.directions.size() - 1;
    for (std::size_t ring = 0; ring < rings; ++ring) {
      mesh_.boundary.push_back({node(0, ring), node(0, ring + 1), fan.side_after});
      mesh_.boundary.push_back({node(last, ring + 1), node(last, ring), fan.side_before});
    }
  }

  const GroundScene& scene_;
  const GroundOutline& outline_;
  double longest_;
  std::vector<GroundFan> fans_;
  std::vector<std::vector<shape::Ring>> regions_;
  Triangulation triangulation_;
  mesh::Mesh mesh_;
  std::map<std::pair<double, double>, int> nodes_;
};

}  // namespace

const bool can_mesh_ground = true;

mesh::Mesh ground_mesh(const GroundScene& scene, const GroundOutline& outline,
                       const GroundFineness& fineness) {
  return Mesher(scene, outline, fineness).mesh();
}

}  // namespace limit::ground
