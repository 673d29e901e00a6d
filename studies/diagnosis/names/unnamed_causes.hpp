#pragma once

#include "diagnosis/proof/prove.hpp"

namespace flexspline::studies {

/// Takes the names of causes that recordings held out confirm and whose name is less likely than
/// limits.probability, or that add less than limits.interest to the model that stands: a doubted
/// name is no reason to predict worse. Where the named causes alone leave no more than noise, and,
/// with nothing named, none adds limits.interest, where one would be implausible, or where none is
/// in the catalogue and a table (unnamed_part) follows what is missing better on recordings held
/// out, these are withdrawn; else they stay, behind the named ones; what they follow is then left
/// over beside the names, which may fall below the limit by it and go the same way. What is outside
/// the catalogue has no name at all. Selection has what the named causes leave, as that is what no
/// name explains. proof: of all the causes, with the evidence of their names; what is returned has
/// the errors of the model that stays, and the named causes as they were proved beside the others.
Result<Proof> take_improbable_names(const Frame& frame, const Limits& limits, Selection& selection,
                                    Proof proof);

}  // namespace flexspline::studies
