// How often the 95 % bands of f, g^-1 and h hold the truth, over drawn gears of classes that no
// estimator fits: flexspline_band_coverage [replicates [threads [first [options key=value]]]].
// motion=travels, no option of the method: the angle travels and h is 1.
#include <cstdio>
#include <cstdlib>

#include "band_coverage.hpp"

namespace flexspline::estimators {
namespace {

void print(std::string_view family, std::string_view colour, const CoverageTally& all) {
  std::printf("%-28s %-10s %5d %5.1f %5.1f %5.1f  %4d %4d %4d %3d  %8.5f %8.5f %8.5f %8.5f %6.2f\n",
              family.data(), colour.data(), all.sets, 100.0 * share(all.f),
              100.0 * share(all.g_inverse), 100.0 * share(all.h), all.printed, all.identifiable,
              all.overconfident, all.failed, median(all.f_width), median(all.g_width),
              median(all.h_width), median(all.h_error), median(all.seconds));
}

int run(int argc, char** argv) {
  const auto argument = [&](int k, unsigned otherwise) {
    return argc > k ? static_cast<unsigned>(std::strtoul(argv[k], nullptr, 10)) : otherwise;
  };
  Options options;
  for (int k = 4; k < argc; ++k) {
    const std::string_view text(argv[k]);
    const auto at = text.find('=');
    options.words[std::string(text.substr(0, at))] = text.substr(at + 1);
  }
  const bool travels = options.words.erase("motion") > 0;
  const auto families =
      std::span(kGearFamilies).first(travels ? kFamiliesOfTorque : kGearFamilies.size());
  const auto tallies =
      band_coverage(families, argument(1, 25), argument(3, 1), argument(2, 2), options,
                    travels ? CoverageMotion::travels : CoverageMotion::torsion);
  std::printf(
      "covered %%: f, g^-1, h; sets: h printed, identifiable, overconfident, failed; medians of "
      "rms "
      "half widths (share of %g Nm, h itself), of the error of h, s\n",
      kPeak);
  for (std::size_t k = 0; k < families.size(); ++k) {
    CoverageTally whole;
    for (std::size_t c = 0; c < kNoiseColours.size(); ++c) {
      print(families[k].name, kNoiseColours[c].name, tallies[k][c]);
      whole.add(tallies[k][c]);
    }
    print(families[k].name, "all", whole);
  }
  return 0;
}

}  // namespace
}  // namespace flexspline::estimators

int main(int argc, char** argv) { return flexspline::estimators::run(argc, argv); }
