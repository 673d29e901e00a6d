#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "flexspline/reports/figure.hpp"
#include "flexspline/reports/study_view.hpp"
#include "flexspline/reports/table.hpp"

namespace flexspline::reports {

struct Paragraph {
  std::string text;
};

/// The sentence that answers a section's question.
struct Verdict {
  std::string text;
};

/// What the blocks behind it are about.
struct Heading {
  std::string text;
};

/// Something to copy, as it stands.
struct Listing {
  std::string text;
};

/// Set as mathematics; in the linear notation of equation.hpp.
struct Equation {
  std::string text;
};

using Content = std::variant<Verdict, Paragraph, Heading, Figure, Table, Listing, Equation>;

/// A piece of a section; folded pieces wait behind their summary, neighbours of one summary
/// together.
struct Block {
  Content content;
  std::string folded_under;  ///< summary of the fold; empty: shown at once
};

/// A question and its answer.
struct Section {
  std::string id;
  std::string title;
  std::vector<Block> blocks;

  void add(Content content) { blocks.push_back({std::move(content), {}}); }
  void fold(std::string summary, Content content) {
    blocks.push_back({std::move(content), std::move(summary)});
  }
};

/// A row of a catalogue of sections: where it stands, and how it is drawn from one kind of view. A
/// section whose artefacts are absent gives nothing.
template <class View>
struct SectionOf {
  int order = 0;
  std::optional<Section> (*draw)(const View& view) = nullptr;
};

using SectionRow = SectionOf<StudyView>;

/// Every section, one file each in reports/sections.
std::span<const SectionRow> sections();

}  // namespace flexspline::reports
