#include <fmt/format.h>

#include "export/c_model.hpp"
#include "export/rigid_joint.hpp"
#include "export/xml.hpp"

namespace flexspline::data {
namespace {

Result<Carried> carry(const RigModel& model) { return carry_rigidly(model, "SDF"); }

Result<std::vector<ExportedFile>> write(const RigModel& model, const ExportHead& head) {
  const RigidJoint joint = rigid_joint(model.drive);
  const double about = joint.inertia + joint.motor_inertia;
  const std::string text = fmt::format(
      R"(<?xml version="1.0"?>
<!-- A harmonic drive as a joint, written by flexspline. SI: rad, Nm, s. The load's inertia contains
     the motor's, N^2 J1 = {6} kg m2. Some engines ignore friction.
{0} -->
<sdf version="1.9">
  <model name="{1}">
    <link name="load">
      <inertial>
        <pose>0 0 {2} 0 0 0</pose>
        <mass>{3}</mass>
        <inertia><ixx>{4}</ixx><ixy>0</ixy><ixz>0</ixz><iyy>{4}</iyy><iyz>0</iyz><izz>{4}</izz></inertia>
      </inertial>
    </link>
    <joint name="joint" type="revolute">
      <parent>world</parent>
      <child>load</child>
      <axis>
        <xyz>0 1 0</xyz>
        <dynamics>
          <damping>{5}</damping>
          <friction>{7}</friction>
        </dynamics>
      </axis>
    </joint>
  </model>
</sdf>
)",
      xml_comment(commented(head, "     ")), head.name, -joint.arm, joint.mass, about,
      joint.damping, joint.motor_inertia, joint.friction);
  return std::vector<ExportedFile>{{head.name + ".sdf", text}};
}

}  // namespace

ExporterRow describe_sdf() {
  return {.id = "sdf",
          .says = "a joint with damping and friction for SDFormat (Gazebo)",
          .carries = "inertia with the motor's, weight, viscous and dry friction",
          .not_carried = "compliance and hysteresis; every effect; the gear ratio",
          .carry = carry,
          .write = write};
}

}  // namespace flexspline::data
