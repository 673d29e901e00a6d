#include <fmt/format.h>

#include "export/c_model.hpp"
#include "export/rigid_joint.hpp"
#include "export/xml.hpp"

namespace flexspline::data {
namespace {

Result<Carried> carry(const RigModel& model) { return carry_rigidly(model, "URDF"); }

Result<std::vector<ExportedFile>> write(const RigModel& model, const ExportHead& head) {
  const RigidJoint joint = rigid_joint(model.drive);
  const double about = joint.inertia + joint.motor_inertia;
  const std::string text = fmt::format(
      R"(<?xml version="1.0"?>
<!-- A harmonic drive as a joint, written by flexspline. SI: rad, Nm, s. The load's inertia contains
     the motor's, N^2 J1 = {6} kg m2, which URDF has no place for. Some engines ignore friction.
{0} -->
<robot name="{1}">
  <link name="base"/>
  <link name="load">
    <inertial>
      <origin xyz="0 0 {2}"/>
      <mass value="{3}"/>
      <inertia ixx="{4}" ixy="0" ixz="0" iyy="{4}" iyz="0" izz="{4}"/>
    </inertial>
  </link>
  <joint name="joint" type="continuous">
    <parent link="base"/>
    <child link="load"/>
    <axis xyz="0 1 0"/>
    <dynamics damping="{5}" friction="{7}"/>
  </joint>
  <transmission name="gear">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="joint"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
    <actuator name="motor"><mechanicalReduction>{8}</mechanicalReduction></actuator>
  </transmission>
</robot>
)",
      xml_comment(commented(head, "     ")), head.name, -joint.arm, joint.mass, about,
      joint.damping, joint.motor_inertia, joint.friction, model.drive.gear_ratio);
  return std::vector<ExportedFile>{{head.name + ".urdf", text}};
}

}  // namespace

ExporterRow describe_urdf() {
  return {.id = "urdf",
          .says = "a joint with damping and friction for URDF",
          .carries = "inertia with the motor's, weight, viscous and dry friction, gear ratio",
          .not_carried = "compliance and hysteresis; every effect",
          .carry = carry,
          .write = write};
}

}  // namespace flexspline::data
