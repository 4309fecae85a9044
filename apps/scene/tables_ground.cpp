#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "tables/builder.hpp"

namespace scene {

namespace {

SceneTable mesh() {
  return tables::TableBuilder<Scene, MeshFile>(
             "mesh", &Scene::mesh,
             "A mesh of Gmsh whose physical groups are regions and sides: surfaces and curves of a "
             "plane one, volumes and surfaces of a solid one. Once read, outlines and, where "
             "particles are elements, the mesh are in the scene, and so in checkpoints.")
      .key("file", &MeshFile::file,
           {.doc = "Its path from the scene's folder: MSH 4.1 or 2.2, as text; empty: none."})
      .key("unit", &MeshFile::unit,
           {.unit = "m", .range = tables::positive(), .doc = "Of its coordinates; 0.001 for mm."})
      .key("particles", &MeshFile::particles,
           {.doc = "cells: of the elements only the outlines of groups count, and particles are "
                   "those of the lattice or tree, as in any region. elements: there is a particle "
                   "at the centroid of each element, which stands for its volume; triangles, "
                   "quadrilaterals, tetrahedra, hexahedra, prisms and pyramids with straight "
                   "edges. A solid body's are elements."})
      .key("text", &MeshFile::text, {.doc = "The mesh itself, in place of its file."})
      .build();
}

SceneTable region() {
  return tables::TableBuilder<Scene, Region>(
             "region", &Scene::region,
             "A polygon of one material, in space a prism along z, or a volume of a solid mesh; "
             "regions adjoin each other and are the body. With the layout cell only. fpm-limit "
             "reads the same of plane ones.")
      .key("name", &Region::name, {.doc = "Serves messages."})
      .key("material", &Region::material,
           {.need = tables::Need::required, .doc = "Name of its material."})
      .key("group", &Region::group,
           {.doc = "Physical surface of [mesh], by name or number, in place of outline and holes; "
                   "of a solid mesh physical volume. Parts of a surface that do not hang together "
                   "become regions of their own."})
      .key("outline", &Region::outline,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc =
                "Its corners, either way around, [[x, y], ...]. Among them, as everywhere in lists "
                "of points, arcs { centre = [x, y], radius = r, from = degrees, to = degrees, "
                "chords = n }: from the direction +x, counterclockwise if to is more; a whole "
                "circle without from and to. It becomes chords between points on it, at whole "
                "multiples of an angle and at its ends, n to a circle, 144 if not given.",
            .absent = "that of group"})
      .key("holes", &Region::holes,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Polygons within it that are not of it: cavities, whose surface is a side, or "
                   "filled by other regions.",
            .absent = "none"})
      .build();
}

SceneTable side() {
  return tables::TableBuilder<Scene, OutlineSide>(
             "side", &Scene::side,
             "A part of the outline of all regions together; every part belongs to one. On a face "
             "of the box that is held alike everywhere it is a [[support]] or a [[symmetry]], "
             "which --print-effective shows; a [[support]] of its name says more of that, such as "
             "its method. Elsewhere particles are tied to it. fpm-limit reads the same.")
      .key("name", &OutlineSide::name,
           {.need = tables::Need::required, .doc = "Unique; serves messages and reactions."})
      .key("kind", &OutlineSide::kind,
           {.need = tables::Need::required,
            .doc = "free: nothing acts on it. loaded: pressure and shear do. fixed: it is held. "
                   "roller, symmetry: it is held across, and free along. footing: a rigid plate, "
                   "what the drive moves or loads."})
      .key("group", &OutlineSide::group,
           {.doc = "Physical curve of [mesh], by name or number, in place of along; of a solid "
                   "mesh physical surface."})
      .key("along", &OutlineSide::along,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "A polyline on the outline.",
            .absent = "that of group"})
      .key("pressure", &OutlineSide::pressure,
           {.unit = "Pa", .doc = "loaded: on the body, a dead load, there from the start."})
      .key("shear", &OutlineSide::shear,
           {.unit = "Pa",
            .doc = "loaded: along the surface, in the direction that has the body to its left; "
                   "likewise."})
      .key("live_pressure", &OutlineSide::live_pressure,
           {.unit = "Pa", .doc = "loaded: what grows with traction in drive.scales."})
      .key("live_shear", &OutlineSide::live_shear, {.unit = "Pa", .doc = "loaded: likewise."})
      .key("base", &OutlineSide::base, {.doc = "footing: whether the ground slides along it."})
      .key("tension", &OutlineSide::tension,
           {.doc = "footing: false: it may lift off, by drive.method contact."})
      .build();
}

SceneTable load() {
  return tables::TableBuilder<Scene, Load>(
             "load", &Scene::load,
             "What fpm-limit seeks on the same ground; fpm-run takes kh and kv from it.")
      .key("sought", &Load::sought,
           {.need = tables::Need::optional,
            .doc = "What grows until collapse: the footing's pressure, live pressures and shears, "
                   "unit weights, what the strength may be divided by, or kh.",
            .absent = "what the drive lets grow"})
      .key("inclination", &Load::inclination,
           {.unit = "deg",
            .range = {.lower = -90.0, .upper = 90.0, .lower_open = true, .upper_open = true},
            .doc = "Of the footing's load from the base's normal, towards +x (or +y); fpm-limit "
                   "only."})
      .key("eccentricity", &Load::eccentricity,
           {.unit = "m",
            .doc = "Of the footing's load from the base's middle, likewise; fpm-limit only."})
      .key("kh", &Load::kh,
           {.doc = "Of an earthquake: horizontal weight over weight, along +x or, if negative, "
                   "-x."})
      .key(
          "kv", &Load::kv,
          {.range = {.lower = -1.0, .upper = 1.0, .upper_open = true},
           .doc = "Of an earthquake: the share of the weight that it lifts. A gravity.acceleration "
                  "that is given has it in it already."})
      .key("guided", &Load::guided,
           {.need = tables::Need::optional,
            .doc = "The footing moves along its normal alone; fpm-limit only.",
            .absent = "if the drive moves it, unless drive.at lets it turn"})
      .build();
}

SceneTable water() {
  return tables::TableBuilder<Scene, Water>(
             "water", &Scene::water,
             "Pore water whose pressure is given: it is not coupled to the ground, which does not "
             "consolidate. Stress is then effective, and so are cohesion and friction; tractions, "
             "pressures, reactions and a footing's pressure are in addition to the water's, which "
             "presses on flooded faces by itself. In 3D up is y, and all is the same along z. "
             "fpm-limit reads the same.")
      .key("table", &Water::table,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Its level, a polyline from left to right over all of the ground. Pressure is "
                   "hydrostatic below it and zero above; it may stand above the ground.",
            .absent = "no table"})
      .key("unit_weight", &Water::unit_weight,
           {.unit = "N/m3", .range = tables::positive(), .doc = "Of water."})
      .key("r_u", &Water::r_u,
           {.need = tables::Need::optional,
            .range = {.lower = 0.0, .upper = 1.0, .upper_open = true},
            .doc = "Instead of a table: the pressure is this share of the weight of the ground "
                   "straight above, over its area. Bodies of regions only.",
            .absent = "the table says it"})
      .key("pore_pressure", &Water::pore_pressure,
           {.need = tables::Need::optional,
            .unit = "Pa",
            .doc = "Instead of a table: the pressure itself, artesian, or of water that seeps, all "
                   "over the ground. Between points and between a raster's values it is linear, in "
                   "Delaunay's triangles and in two of each square; they reach to the ground's "
                   "edges. Less than none, suction, counts as none; ground is saturated where it "
                   "is more.",
            .absent = "the table says it"})
      .build();
}

}  // namespace

std::vector<SceneTable> ground_tables() {
  return {mesh(), region(), side(), load(), water()};
}

}  // namespace scene
