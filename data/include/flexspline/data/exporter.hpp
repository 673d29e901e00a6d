#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// One file of an export, by its path inside the folder. executable: to be run.
struct ExportedFile {
  std::string path;
  std::string content;
};

/// Something of a model that a target has no place for.
struct Lost {
  std::string what;
  std::string why;
  RigModel without;         ///< the whole model with this alone lost
  bool instrument = false;  ///< it belongs to the recording, not to the machine
};

/// A model as a target holds it: `model` is what the exported form computes, so that simulating
/// both tells what was lost.
struct Carried {
  RigModel model;
  std::vector<Lost> lost;
};

/// What an export is called and what stands at the head of its files.
struct ExportHead {
  std::string name;                  ///< an identifier in C and XML
  std::vector<std::string> remarks;  ///< provenance, what was lost and by how much; one a line
};

/// A row of the catalogue of exporters: a form in which other programs take a model.
struct ExporterRow {
  std::string_view id;
  std::string_view says;
  std::string_view carries;      ///< what of a model the form holds
  std::string_view not_carried;  ///< and what it has no place for
  /// Errors: a model that the target cannot hold at all.
  Result<Carried> (*carry)(const RigModel&) = nullptr;
  /// The files of a model that carry() returned.
  Result<std::vector<ExportedFile>> (*write)(const RigModel&, const ExportHead&) = nullptr;
};

/// Every exporter, one file each in data/exporters.
std::span<const ExporterRow> exporters();

/// Errors: usage, for an exporter that does not exist, with the nearest that does.
Result<const ExporterRow*> find_exporter(std::string_view id);

}  // namespace flexspline::data
