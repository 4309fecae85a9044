#include "scene/contacts.hpp"

#include <algorithm>
#include <string>

#include "scene/course.hpp"
#include "scene/drives.hpp"
#include "scene/scene.hpp"

namespace scene {

namespace {

bool has_rigid_contact(const Scene& scene) {
  return std::ranges::count(scene.support, SupportMethod::contact, &Support::method) > 0 ||
         std::ranges::any_of(all_drives(scene), [](const Drive* drive) {
           return drive->method == DriveMethod::contact;
         });
}

bool is_contact_by_default(const Scene& scene) {
  return scene.approximation.interfaces == InterfaceKind::contact && scene.material.size() > 1;
}

}  // namespace

bool has_contact(const Scene& scene) {
  return is_contact_by_default(scene) || has_rigid_contact(scene) ||
         std::ranges::count(scene.interface, InterfaceKind::contact, &Interface::kind) > 0;
}

bool has_weakened_contact(const Scene& scene) {
  return is_contact_by_default(scene) || has_rigid_contact(scene) ||
         std::ranges::any_of(scene.interface, [&](const Interface& interface) {
           return interface.kind == InterfaceKind::contact &&
                  std::ranges::any_of(interface.between, [&](const std::string& name) {
                    return is_weakened(scene, name);
                  });
         });
}

}  // namespace scene
