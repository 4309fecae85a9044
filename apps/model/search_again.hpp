#pragma once

#include <vector>

#include "model/model.hpp"
#include "model/state.hpp"

namespace model {

/// Searches rows anew that had been before the body changed: a neighbourhood of particles that are
/// where they are now, new ones among them, in place of one that is no longer whole. What such a
/// row has strained since the beginning is first taken from the initial neighbourhoods of the body
/// as it is, on which those rows stay that cannot be searched anew.
/// @param former  the state of the body before
/// @param source  of each particle the same one in it, or -1
/// @param load  load parameter, to which moving planes of images have come
/// @param[in,out] carried  of the body as it is, on its initial rows
template <int Dim>
void search_again(const State<Dim>& former, const std::vector<fpm::Index>& source,
                  const Model<Dim>& after, double load, State<Dim>& carried);

}  // namespace model
