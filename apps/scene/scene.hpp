#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/choices.hpp"
#include "scene/curved_strength.hpp"
#include "scene/mesh_file.hpp"
#include "tables/table.hpp"

namespace scene {

/// Coordinates or components, one per space dimension (the reader has checked the length).
using Point = std::vector<double>;

// Every key below has its unit, range, default, meaning and source in one place, the field table
// (tables_*.cpp), which also makes share/doc/scene.md. Units are SI, tension is positive.

/// The box that is filled by a lattice of particles: the body, or around its regions.
struct Geometry {
  int dimension = 2;
  Point min;             // [m] once read, of regions as well
  Point max;             // [m]
  double spacing = 0.0;  // [m] a whole number of times in each extent
  Layout layout = Layout::cell;
  double jitter = 0.0;  // [fraction of spacing]
  std::int64_t seed = 1;
  Point depth{};  // [m] from and to along z, of polygons that are prisms; else empty
  bool operator==(const Geometry&) const = default;
};

/// A place in the plane [m].
class PlanePoint {
 public:
  PlanePoint(double x, double y) : x_(x), y_(y) {}
  double x() const { return x_; }
  double y() const { return y_; }
  bool operator==(const PlanePoint&) const = default;

 private:
  double x_, y_;
};

/// A polygon of one material, and what of it is not.
struct Region {
  std::string name;
  std::string material;             // its name
  std::vector<PlanePoint> outline;  // either way around
  std::vector<std::vector<PlanePoint>> holes;
  std::string group;     // of a mesh, which gives outline and holes; empty once read
  bool present = true;   // in the stage at hand; no key
  double lowest = 0.0;   // [m] level y of its lowest place, once completed; no key
  double highest = 0.0;  // [m] likewise
  bool operator==(const Region&) const = default;
};

/// A part of the outline of all regions together, and what it is.
struct OutlineSide {
  std::string name;
  OutlineKind kind = OutlineKind::free;
  std::vector<PlanePoint> along;  // a polyline, either way
  std::string group;              // of a mesh, which gives it; empty once read
  double pressure = 0.0;          // [Pa] on the body, constant
  double shear = 0.0;             // [Pa] along the surface, with the body to the left, constant
  double live_pressure = 0.0;     // [Pa] likewise, at load parameter 1
  double live_shear = 0.0;        // [Pa]
  Base base = Base::rough;        // of a footing
  bool tension = true;            // of a footing: whether it holds on to the ground
  bool operator==(const OutlineSide&) const = default;
};

/// What fpm-limit seeks on the same ground, and the weight aslant of an earthquake.
struct Load {
  std::optional<Sought> sought;
  double inclination = 0.0;    // [deg]
  double eccentricity = 0.0;   // [m]
  double kh = 0.0;             // horizontal weight over weight
  double kv = 0.0;             // share of the weight that is lifted
  std::optional<bool> guided;  // of a footing
  bool operator==(const Load&) const = default;
};

/// Pore water, whose pressure is given; at most one of table, r_u and pore_pressure.
struct Water {
  std::vector<PlanePoint> table;  // [m] from left to right; hydrostatic below, nothing above
  double unit_weight = 9810.0;    // [N/m3]
  std::optional<double> r_u;      // its pressure over the overburden
  std::optional<tables::VaryingNumber> pore_pressure;  // [Pa] below zero: none
  bool operator==(const Water&) const = default;
};

/// What is cut out of the box, and what acts on the surface that it leaves; either an outline or a
/// circle.
struct Cutout {
  std::string name;
  std::vector<PlanePoint> outline;
  Point centre;                  // [m]
  std::optional<double> radius;  // [m]
  bool outside = false;          // what lies outside is cut away
  CutoutKind kind = CutoutKind::free;
  double pressure = 0.0;  // [Pa] on the body
  double shear = 0.0;     // [Pa] along the surface, with the body to the left
  bool operator==(const Cutout&) const = default;
};

/// How the spacing grows away from where particles are finest.
struct Grading {
  bool enabled = false;
  std::optional<double> growth;  // absent: resolve_growth
  double exponent = 0.5;
  std::optional<double> length;    // [m] absent: resolve_grading_length
  std::optional<double> coarsest;  // [m] absent: resolve_coarsest
  bool operator==(const Grading&) const = default;
};

/// A place where particles are fine; exactly one of side, region and at.
struct Refine {
  std::optional<Side> side;
  Point range_min;                // [m] dimension - 1 entries, or empty: the whole side
  Point range_max;                // [m]
  Point region_min;               // [m]
  Point region_max;               // [m]
  Point at;                       // [m]
  std::optional<double> spacing;  // [m] absent: the finest
  double radius = 0.0;            // [m] of what is as fine around it
  bool operator==(const Refine&) const = default;
};

/// How the fields are approximated between the particles.
struct Approximation {
  KernelKind kernel = KernelKind::cubic_spline;
  double support_over_spacing = 2.4;
  Switch consistency = Switch::automatic;
  KinematicsKind kinematics = KinematicsKind::finite_strain;
  InterfaceKind interfaces = InterfaceKind::tied;  // of materials that no table names
  bool operator==(const Approximation&) const = default;
};

/// One material and where it is; its parameters are described by libconstitutive; the first fills
/// the body, later ones win inside their region.
struct Material {
  std::string name;
  std::string model = "elastic";         // a family of models of libconstitutive
  tables::VaryingNumber youngs_modulus;  // [Pa]
  double poissons_ratio = 0.0;
  std::optional<tables::VaryingNumber> cohesion;  // [Pa] present for every yielding model
  // [deg] present for the frictional models
  std::optional<tables::VaryingNumber> friction_angle, dilation_angle;
  tables::VaryingNumber density;                               // [kg/m3]
  std::optional<tables::VaryingNumber> unit_weight;            // [N/m3] which says the same
  std::optional<tables::VaryingNumber> saturated_unit_weight;  // [N/m3] below the water table
  std::optional<double> dilation_cutoff;                       // accumulated plastic volume strain
  std::optional<double> tension_cutoff;                        // [Pa] largest principal stress
  std::optional<double> residual_strain;                       // equivalent plastic strain
  std::optional<double> residual_cohesion;                     // [Pa]
  std::optional<double> residual_friction_angle;               // [deg]
  std::optional<double> compression_index;        // present for models of critical states
  std::optional<double> swelling_index;           // as is this,
  std::optional<double> critical_stress_ratio;    // this
  std::optional<double> overconsolidation_ratio;  // and this
  CurvedStrength curve;                           // of models with a curved envelope
  std::string match = "plane_strain";             // of a family of several
  Point region_min;                               // [m] empty: everywhere
  Point region_max;                               // [m]
  bool operator==(const Material&) const = default;
};

/// How two bodies, or a body and a rigid one, act on each other where they only touch.
struct Contact {
  double friction_angle = 0.0;  // [deg]
  double adhesion = 0.0;        // [Pa]
  bool tension = false;
  // Times Young's modulus over the spacing; absent: resolve_stiffness_factor.
  std::optional<double> stiffness_factor;
  bool operator==(const Contact&) const = default;
};

/// What happens where two materials meet.
struct Interface {
  std::vector<std::string> between;  // names of two materials
  InterfaceKind kind = InterfaceKind::tied;
  Contact contact;
  bool operator==(const Interface&) const = default;
};

/// Control of zero-energy modes.
struct Hourglass {
  HourglassControl control = HourglassControl::automatic;
  std::optional<double> stiffness_ratio;  // gamma
  double modulus_factor = 1.0;            // chi
  double viscosity = 0.01;                // theta, per step
  bool operator==(const Hourglass&) const = default;
};

/// A mirror at a face of the box.
struct Symmetry {
  Axis axis = Axis::x;
  double position = 0.0;  // [m]
  bool operator==(const Symmetry&) const = default;
};

/// Particles whose displacement is zero in some directions; exactly one of side, region and at.
struct Support {
  std::string name;
  std::optional<Side> side;
  Point region_min;  // [m]
  Point region_max;  // [m]
  Point at;          // [m] the one nearest particle
  std::vector<Axis> directions;
  SupportMethod method = SupportMethod::automatic;
  double penalty_factor = 1e2;  // times Young's modulus
  Contact contact;              // of the method of that name
  bool operator==(const Support&) const = default;
};

/// A traction on a part of one face.
struct Traction {
  std::string name;
  Side side = Side::top;
  Point range_min;  // [m] dimension - 1 entries, or empty: the whole side
  Point range_max;  // [m]
  Point value;      // [Pa]
  bool follower = false;
  bool operator==(const Traction&) const = default;
};

/// Body force per mass.
struct Gravity {
  Point acceleration;  // [m/s2] empty: none
  bool operator==(const Gravity&) const = default;
};

/// The stress before the first step.
struct InitialStress {
  InitialStressKind kind = InitialStressKind::none;
  std::optional<double> surface;  // [m] level y of zero (or surcharge) stress; absent: top face
  std::optional<double> K0;       // absent: nu / (1 - nu)
  std::optional<double> K0_z;     // absent: K0
  double surcharge = 0.0;         // [Pa]
  // [Pa] The same everywhere; sigma_z absent in the plane: of plane strain.
  std::optional<double> sigma_x, sigma_y, sigma_z, sigma_xy, sigma_yz, sigma_zx;
  std::vector<std::string> loaded_sides;  // which that stress itself loads
  bool operator==(const InitialStress&) const = default;
};

/// What is moved or loaded, and how far.
struct Drive {
  std::string name;  // empty: `drive`, or that of its stage
  DriveKind kind = DriveKind::none;
  Side side = Side::top;
  Point range_min;  // [m] dimension - 1 entries, or empty: the whole side
  Point range_max;  // [m]
  Point direction;  // unit vector
  Lateral lateral = Lateral::fixed;
  DriveMethod method = DriveMethod::automatic;
  Contact contact;  // of the method of that name
  Point at;  // [m] along the side, where a plate that turns is pushed or loaded; empty: it does not
  Point force;          // [N/m or N] on a loaded plate
  double target = 0.0;  // [m] length of the prescribed displacement; of a strength drive the factor
  std::vector<std::string> weakened;  // materials whose strength is divided; empty: all
  std::vector<LoadKind> scales;       // what grows from 0 to 1 in a load drive
  std::vector<std::string> loads;  // tractions, sides, cutouts of those; empty: all no other names
  std::optional<double> reference_length;  // B [m]
  std::optional<double> width;             // [m] over which the mean pressure is taken
  // [m] across its side, of a plate whose [[side]] is on no face of the box; no key.
  std::optional<double> level;
  bool on_footing = false;  // it is the one that the [[side]] of a footing is for; no key
  bool later = false;       // it begins, or comes back, when the ground has moved; no key
  std::size_t number = 0;   // among all of a run; no key
  bool operator==(const Drive&) const = default;
};

/// A part of a run: what changes at its beginning, and how far it goes.
struct Stage {
  std::string name;
  std::optional<double> to;  // of the drive at its end: [m] displacement, or factor of a load
  std::optional<double> reduction;  // what strength is divided by at its end
  std::optional<Drive> drive;       // in force from it on; absent: that of before
  std::optional<std::int64_t> steps;
  double fades = 1.0;                                  // share of what its changes leave unbalanced
  std::vector<std::string> remove;                     // regions
  std::vector<std::string> place;                      // regions
  std::vector<std::string> release;                    // supports and drives
  std::vector<std::string> hold;                       // supports
  std::vector<PlanePoint> water_table;                 // [m]
  std::optional<tables::VaryingNumber> pore_pressure;  // [Pa]
  std::optional<double> kh, kv;                        // of an earthquake
  std::vector<std::string> materials;                  // whose values change, to one of each list:
  Point cohesion;                                      // [Pa]
  Point friction_angle;                                // [deg]
  Point dilation_angle;                                // [deg]
  std::vector<std::string> regions;                    // whose material changes, to one each:
  std::vector<std::string> become;                     // materials
  bool operator==(const Stage&) const = default;
};

/// Which stage a scene is, and how far it goes, once it is that of one (stages.hpp); no keys.
struct Course {
  std::size_t stage = 0;
  double load_begin = 0.0;  // load parameter
  double load_end = 1.0;
  double reduction_begin = 1.0;  // what strength is divided by
  double reduction_end = 1.0;
  double fades = 1.0;  // share of what is left unbalanced at its beginning
  bool operator==(const Course&) const = default;
};

/// A drive that is not in force in the stage at hand: it was, or is yet to come; no keys.
struct OtherDrive {
  Drive drive;
  bool acts = false;     // its side stays where it is, its loads stay what they are
  double load = 0.0;     // its load parameter
  std::size_t last = 0;  // the latest stage in which it was in force
  bool operator==(const OtherDrive&) const = default;
};

/// Columns of the curve beside those of the drive.
struct Measure {
  std::string name{};  // with which its columns begin
  MeasureKind kind = MeasureKind::displacement;
  Point at{};                            // [m] of displacement, stress and plastic_strain
  std::optional<std::string> support{};  // of a reaction
  std::optional<Side> side{};            // of a resultant
  bool operator==(const Measure&) const = default;
};

/// How the drive is cut into steps.
struct Programme {
  std::optional<std::int64_t> steps;  // absent: from increment_over_spacing
  double increment_over_spacing = 0.02;
  double minimum_increment_ratio = 1.0 / 1024.0;
  double maximum_increment_ratio = 1.0;
  double growth = 2.0;
  int easy_steps = 10;
  int easy_evaluations = 10;
  int hard_evaluations = 120;
  int patience = 128;
  bool stop_at_failure = true;
  bool operator==(const Programme&) const = default;
};

/// The nonlinear solver; an absent key is the preset's (resolve_solver).
struct Solver {
  SolverPreset preset = SolverPreset::standard;
  std::optional<double> tolerance;
  std::optional<SolverMethod> method;
  std::optional<JacobianKind> jacobian;
  std::optional<PreconditionerKind> preconditioner;
  double coarse_spacing_over_spacing = 3.0;
  int max_evaluations_per_step = 400;
  bool operator==(const Solver&) const = default;
};

/// Local re-search of neighbours where plastic strain has grown.
struct ReSearch {
  bool enabled = false;
  double trigger = 0.15;
  double hysteresis = 0.3;
  bool operator==(const ReSearch&) const = default;
};

/// What is written, where and how often.
struct Output {
  std::optional<std::string> directory;  // absent: out/<stem of the scene file>
  int frames_every = 10;
  int checkpoints_every = 25;
  double checkpoints_every_minutes = 15.0;
  int checkpoints_kept = 3;
  int checkpoints_kept_every = 0;
  int compression = 0;
  std::vector<std::string> fields;  // empty: all
  bool operator==(const Output&) const = default;
};

/// Whether, and how sharply, a footing's run is held against the bounds of its collapse load.
struct Limit {
  bool check = false;
  double gap = 0.02;
  double max_seconds = 120.0;
  bool operator==(const Limit&) const = default;
};

/// A whole run as the user describes it, checked: every cross-field rule holds.
struct Scene {
  std::string title;
  Geometry geometry;
  MeshFile mesh;
  std::vector<Region> region;
  std::vector<OutlineSide> side;
  Load load;
  Water water;
  std::vector<Cutout> cutout;
  Grading grading;
  std::vector<Refine> refine;
  Approximation approximation;
  std::vector<Material> material;
  std::vector<Interface> interface;
  Hourglass hourglass;
  std::vector<Symmetry> symmetry;
  std::vector<Support> support;
  std::vector<Traction> traction;
  Gravity gravity;
  InitialStress initial_stress;
  Drive drive;
  std::vector<Stage> stage;
  std::vector<OtherDrive> other_drives;  // of a scene of a stage; no keys
  Course course;
  std::vector<Measure> measure;
  Programme programme;
  Solver solver;
  ReSearch re_search;
  Output output;
  Limit limit;
  bool operator==(const Scene&) const = default;
};

}  // namespace scene
