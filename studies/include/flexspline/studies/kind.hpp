#pragma once

#include <span>
#include <string_view>

#include "flexspline/studies/answer.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

class TomlSection;
class StudyRows;

/// A row of the catalogue of study kinds: which cases a study consists of, and what they answer.
/// A kind turns what the study file says into inputs, estimators and sweeps; from there on all
/// kinds are planned, run, kept and verified alike.
struct KindRow {
  std::string_view id;
  std::string_view summary;
  std::string_view cases;
  std::string_view question;
  /// Reads the kind's own table ([<id>], empty where there is none) and completes the study; what
  /// is wrong goes to the section. Null: the study is as written.
  void (*read)(TomlSection& own, StudyConfig& study) = nullptr;
  /// What the rows of the cases say. Null, or no sentence: no section of the report.
  KindAnswer (*answer)(const StudyRows& rows) = nullptr;
  bool chooses_training = false;                   ///< estimators need not name a grid to train on
  std::string_view schema = "flexspline-study/1";  ///< of its files
};

/// Every kind, one file each in studies/kinds.
std::span<const KindRow> kinds();

/// Null where there is none of that id.
const KindRow* find_kind(std::string_view id);

}  // namespace flexspline::studies
