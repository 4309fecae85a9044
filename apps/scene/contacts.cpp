#include "scene/contacts.hpp"

#include <algorithm>

#include "scene/drives.hpp"
#include "scene/scene.hpp"

namespace scene {

bool has_contact(const Scene& scene) {
  const bool by_default = scene.approximation.interfaces == InterfaceKind::contact;
  return (by_default && scene.material.size() > 1) ||
         std::ranges::count(scene.interface, InterfaceKind::contact, &Interface::kind) > 0 ||
         std::ranges::count(scene.support, SupportMethod::contact, &Support::method) > 0 ||
         std::ranges::any_of(all_drives(scene), [](const Drive* drive) {
           return drive->method == DriveMethod::contact;
         });
}

}  // namespace scene
