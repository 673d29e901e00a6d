#include <fmt/format.h>

#include "export/c_model.hpp"
#include "export/compile_shared.hpp"
#include "export/filled.hpp"
#include "export/fmi3_text.hpp"
#include "export/xml.hpp"
#include "export/zip.hpp"
#include "flexspline/data/checksum.hpp"

namespace flexspline::data {
namespace {

struct Variable {
  const char* name;
  const char* unit;
  const char* says;
};

constexpr Variable kInputs[] = {{"motor_torque", "Nm", "at the motor shaft"},
                                {"load_torque", "Nm", "external, opposes the output"}};
constexpr Variable kMotion[] = {{"torsion", "rad", "what is imposed"},
                                {"torsion_rate", "rad/s", "its time derivative"}};
constexpr Variable kOutputs[] = {{"motor_angle", "rad", "at the motor"},
                                 {"motor_speed", "rad/s", "at the motor"},
                                 {"load_angle", "rad", "at the output"},
                                 {"load_speed", "rad/s", "at the output"},
                                 {"gear_torsion", "rad", "motor_angle/N - load_angle"},
                                 {"transmitted_torque", "Nm", "across the flexspline"}};

std::string variables_of(Rig rig) {
  std::string text =
      "    <Float64 name=\"time\" valueReference=\"0\" causality=\"independent\" "
      "variability=\"continuous\" unit=\"s\"/>\n";
  int reference = 1;
  for (const Variable& one : rig == Rig::specimen ? kMotion : kInputs) {
    text += fmt::format(
        "    <Float64 name=\"{}\" valueReference=\"{}\" causality=\"input\" "
        "variability=\"continuous\" start=\"0\" unit=\"{}\" description=\"{}\"/>\n",
        one.name, reference++, one.unit, one.says);
  }
  for (const Variable& one : kOutputs) {
    text += fmt::format(
        "    <Float64 name=\"{}\" valueReference=\"{}\" causality=\"output\" "
        "variability=\"continuous\" unit=\"{}\" description=\"{}\"/>\n",
        one.name, reference++, one.unit, one.says);
  }
  return text;
}

std::string structure() {
  std::string outputs;
  std::string unknowns;
  for (std::size_t k = 0; k < std::size(kOutputs); ++k) {
    outputs += fmt::format("    <Output valueReference=\"{}\"/>\n", k + 3);
    unknowns += fmt::format("    <InitialUnknown valueReference=\"{}\"/>\n", k + 3);
  }
  return outputs + unknowns;
}

std::string description(const RigModel& model, const ExportHead& head, const std::string& token) {
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="{0}" instantiationToken="{1}"
    description="{2}" generationTool="flexspline" variableNamingConvention="flat">
  <CoSimulation modelIdentifier="{0}" canHandleVariableCommunicationStepSize="true"
      canGetAndSetFMUState="true" canSerializeFMUState="true"/>
  <UnitDefinitions>
    <Unit name="s"><BaseUnit s="1"/></Unit>
    <Unit name="rad"><BaseUnit rad="1"/></Unit>
    <Unit name="rad/s"><BaseUnit rad="1" s="-1"/></Unit>
    <Unit name="Nm"><BaseUnit kg="1" m="2" s="-2"/></Unit>
  </UnitDefinitions>
  <DefaultExperiment startTime="0" stopTime="10" stepSize="0.001"/>
  <ModelVariables>
{3}  </ModelVariables>
  <ModelStructure>
{4}  </ModelStructure>
</fmiModelDescription>
)",
                     head.name, token, xml_escaped("A harmonic drive. " + commented(head, "")),
                     variables_of(model.rig), structure());
}

std::string build_description(const std::string& name) {
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiBuildDescription fmiVersion="3.0">
  <BuildConfiguration modelIdentifier="{0}">
    <SourceFileSet language="C99">
      <SourceFile name="{0}.c"/>
      <SourceFile name="fmi3.c"/>
    </SourceFileSet>
    <Library name="m" external="true"/>
  </BuildConfiguration>
</fmiBuildDescription>
)",
                     name);
}

Result<std::vector<ExportedFile>> write(const RigModel& model, const ExportHead& head) {
  auto c = c_model(model, head);
  if (!c) return tl::unexpected(c.error());
  const std::string token = fmt::format("{{{}}}", sha256_hex(c->header + c->source).substr(0, 32));
  const std::vector<ExportedFile> sources = {
      {head.name + ".h", std::move(c->header)},
      {head.name + ".c", std::move(c->source)},
      {"fmi3.c", filled(kFmi3Source, {{"name", head.name}, {"token", token}})}};
  std::vector<ExportedFile> files = {
      {"modelDescription.xml", description(model, head, token)},
      {"sources/buildDescription.xml", build_description(head.name)}};
  for (const ExportedFile& one : sources) files.push_back({"sources/" + one.path, one.content});
  if (const auto library = compile_shared(sources)) {
    files.push_back(
        {fmt::format("binaries/{}/{}.so", FLEXSPLINE_FMI_PLATFORM, head.name), *library});
  }
  auto archive = zipped(files);
  if (!archive) return tl::unexpected(archive.error());
  return std::vector<ExportedFile>{{head.name + ".fmu", std::move(*archive)}};
}

}  // namespace

ExporterRow describe_fmu() {
  return {
      .id = "fmu",
      .says = "FMI 3.0 co-simulation, with sources and, where there is a C compiler, the binary",
      .carries = "what c99 carries",
      .not_carried = "what c99 does not; inputs are held over a communication step",
      .carry = carry_in_c,
      .write = write};
}

}  // namespace flexspline::data
