#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/holders.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "model/stress_point.hpp"
#include "record/curve.hpp"
#include "scene/choices.hpp"
#include "scene/drives.hpp"
#include "scene/scene.hpp"

namespace scene {
struct Measure;
struct Scene;
}  // namespace scene

namespace model {

/// What a run's curve shows beside its drive, as the scene's [[measure]] asks for, or
/// scene::resolve_measures. Between steps; it changes nothing.
template <int Dim>
class Measures {
 public:
  /// @param model  must outlive it
  /// @throws std::runtime_error if a point is too far from all particles.
  Measures(const scene::Scene& scene, const Model<Dim>& model);

  /// Names of the columns, each with its unit: first the stage, from 1, and what strength is
  /// divided by, in a run that has several and that divides it; then where each drive stands, if
  /// there are several, and by how much each plate has turned that does, from x to y.
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  /// Their values, in the same order.
  [[nodiscard]] std::vector<double> of(const State<Dim>& state) const;

 private:
  /// A traction on a side.
  struct Load {
    fpm::Vector<Dim> force;                // [N/m or N] of a dead load, whole
    scene::LoadShare share;                // of it, what stays and what grows
    std::optional<std::size_t> following;  // the model's, of one that follows the boundary
  };
  struct Measure {
    scene::MeasureKind kind;
    fpm::PointOperator<Dim> point;           // of a displacement
    StressPoint<Dim> stress;                 // of a stress
    Eigen::Index particle = 0;               // of a particle's stress or plastic strain
    typename Holders<Dim>::Shares unknowns;  // of a reaction or resultant
    std::vector<std::size_t> penalties;      // the model's, of a reaction or resultant
    std::vector<Load> loads;                 // of a resultant
    // Points of interfaces, and the area of each, of a reaction or resultant.
    std::vector<std::pair<Eigen::Index, double>> contacts;
  };

  void locate(const scene::Scene& scene, const scene::Measure& asked, Measure& measure) const;
  void find_support(const scene::Scene& scene, const std::string& name, Measure& measure) const;
  void add_contacts(std::string Interface<Dim>::*of, const std::string& name,
                    Measure& measure) const;
  void name_drives(const scene::Scene& scene);
  void name_rotations(const scene::Scene& scene);
  [[nodiscard]] Eigen::Index plate_of(const std::string& drive) const;
  void find_side(const scene::Scene& scene, scene::Side side, Measure& measure) const;
  void name_columns(const scene::Measure& asked);
  fpm::Vector<Dim> force(const Measure& measure, const State<Dim>& state) const;

  const Model<Dim>& model_;
  Holders<Dim> holders_;
  /// Where a drive stands.
  struct Place {
    bool moves;    // with the load parameter
    double held;   // load parameter, if it does not
    double scale;  // [m] of a displacement, else 1
  };

  scene::Course course_;
  bool has_stages_ = false, reduces_strength_ = false;
  std::vector<Place> drives_;  // of a run with several
  // Of plates that turn: about which axis, and which of the state's, or -1.
  std::vector<std::pair<Eigen::Index, Eigen::Index>> rotations_;
  std::vector<Measure> measures_;
  std::vector<std::string> columns_;
};

/// The last step of each stage of a curve that has gone on to another.
/// @param columns  what it measures
[[nodiscard]] std::vector<std::int64_t> stage_ends(const std::vector<std::string>& columns,
                                                   const std::vector<record::CurveRow>& rows);

}  // namespace model
