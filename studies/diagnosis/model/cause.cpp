#include "diagnosis/model/cause.hpp"

#include <algorithm>

#include "diagnosis/model/cause_by_law.hpp"

namespace flexspline::studies {
namespace {

bool acts_on(const CauseForm& form, Equation equation) {
  return std::ranges::find(form.at, equation) != form.at.end();
}

// What resists at the load beside its inertia, the torsion's equation lacks and the motor has to
// bring up. An error of the inertia itself rescales f and g, and only the motor tells it.
CauseForm by_inertia(const CauseForm& form) {
  CauseForm other = form;
  const bool across = acts_on(form, Equation::torsion);
  other.at = {Equation::motor};
  if (form.stated != &Frame::load_inertia) other.at.insert(other.at.begin(), Equation::torsion);
  other.where = [where = form.where](const Frame& f) {
    return f.torque_by_inertia && (where == nullptr || where(f));
  };
  if (form.columns == nullptr) return other;
  other.columns = [columns = form.columns, across](Equation equation, const Frame& f,
                                                   const Reference& known,
                                                   std::span<const double> shape) {
    Columns list = columns(Equation::load, f, known, shape);
    const double share = equation == Equation::motor ? 1.0 / f.ratio : -1.0;
    for (Eigen::ArrayXd& column : list) column *= share;
    if (equation == Equation::motor || !across) return list;
    const Columns own = columns(Equation::torsion, f, known, shape);
    for (std::size_t k = 0; k < list.size(); ++k) list[k] += own[k];
    return list;
  };
  return other;
}

// What acts on the load's equation and on the motor's is what a torque sensor reads.
void add_forms_by_inertia(CauseRow& row) {
  const std::size_t count = row.forms.size();
  for (std::size_t i = 0; i < count; ++i) {
    const CauseForm& form = row.forms[i];
    if (!acts_on(form, Equation::load) || acts_on(form, Equation::motor)) continue;
    row.forms.push_back(by_inertia(form));
  }
}

}  // namespace

std::span<const CauseRow> causes() {
  static const std::vector<CauseRow> all = [] {
    const auto written = written_causes();
    std::vector<CauseRow> rows(written.begin(), written.end());
    for (const EffectRow& effect : effects()) {
      if (std::ranges::find(written, effect.id, &CauseRow::id) != written.end()) continue;
      if (auto row = cause_by_law(effect)) rows.push_back(*std::move(row));
    }
    std::ranges::for_each(rows, add_forms_by_inertia);
    std::ranges::sort(rows, {}, &CauseRow::id);
    return rows;
  }();
  return all;
}

Equation first_equation(const Frame& frame, const CauseForm& form) {
  for (Equation e : form.at) {
    if (frame.has(e)) return e;
  }
  return form.at.front();
}

std::vector<const CauseForm*> forms_on(const CauseRow& row, const Frame& frame) {
  std::vector<const CauseForm*> list;
  for (const CauseForm& form : row.forms) {
    const bool exists = std::ranges::count(form.rigs, frame.rig) > 0;
    const bool seen =
        std::ranges::any_of(form.at, [&](Equation equation) { return frame.has(equation); });
    const bool fits = exists && (form.where == nullptr || form.where(frame));
    const bool whole = !frame.torque_by_inertia || !acts_on(form, Equation::load);
    if (seen && fits && whole) list.push_back(&form);
  }
  return list;
}

}  // namespace flexspline::studies
