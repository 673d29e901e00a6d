#include "flexspline/studies/kind.hpp"
#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kBench =
    "[bench]\ntorque_noise_white = { value = 0.5, unit = \"%\" }\ncycles = 3\nsamples_per_cycle = "
    "100\n";
const std::string kLoops =
    "[[grid]]\nid = \"loops\"\nloops = { values = [[0.2, 0.005], [0.1, 0.005]], units = [\"deg\", "
    "\"Hz\"] }\n";
const std::string kTruth = "[[input]]\nid = \"table_i\"\ntruth = \"table_i\"\n";
const std::string kPooled = "[[estimator]]\nid = \"pooled\"\nmethod = \"midpoint_pooled\"\n";

std::string on_given_recordings() {
  const std::string root = FLEXSPLINE_SOURCE_DIR;
  return "[[input]]\nid = \"gear\"\ndataset = \"" + root +
         "/docs/examples/locked-gear\"\n[[estimator]]\nid = \"m\"\nmethod = \"model_file\"\nmodel "
         "= \"" +
         root + "/studies/models/locked-gear-ladder.toml\"\n";
}

/// A small study of each kind; empty: there is none for that one yet.
std::string small_study(std::string_view kind) {
  const std::string head = kHead + "kind = \"" + std::string(kind) + "\"\n";
  const std::string trained = kPooled + "train = \"loops\"\n";
  if (kind == "grid") {
    return kHead + kBench +
           "[[sweep]]\nkey = \"bench.torque_noise_white\"\nunit = \"%\"\nvalues = [0.1, 1.0]\n" +
           kLoops + kTruth + trained;
  }
  if (kind == "generalisation") {
    return head + "[generalisation]\nlargest_set = 1\n" + kBench + kLoops + kTruth + kPooled;
  }
  if (kind == "robustness") {
    return head + "[robustness]\ntorque_noise_white = [0.5, 4.0]\nmissing_samples = [30.0]\n" +
           kBench + kLoops + kTruth + trained;
  }
  if (kind == "coverage") {
    return head + "replicates = 4\n[coverage]\nranks = 2\n" + kBench + kLoops + kTruth + trained;
  }
  if (kind == "sensitivity") {
    return head +
           "[sensitivity]\nsamples = 4\noutputs = [\"loop_area\"]\nkeys = [{ key = "
           "\"input.table_i.strength.damping\", from = 0.5, to = 1.5 }]\n" +
           kBench + kLoops + kTruth + trained;
  }
  if (kind == "excitation") {
    return head + "[excitation]\nrecorded = \"loops\"\ncandidates = \"more\"\n" + kBench + kLoops +
           "[[grid]]\nid = \"more\"\nloops = { values = [[0.2, 0.05]], units = [\"deg\", \"Hz\"] "
           "}\n" +
           kTruth + kPooled;
  }
  if (kind == "multistart") return head + "[multistart]\nstarts = 2\n" + on_given_recordings();
  if (kind == "model_ladder") return head + "[model_ladder]\neffects = 1\n" + on_given_recordings();
  if (kind == "profile") {
    return head + "[profile]\npoints = 1\nparameters = [\"f[0]\"]\n" + on_given_recordings();
  }
  if (kind == "trial") {
    return "schema = \"flexspline-trial/1\"\nname = \"t\"\nseed = 4\nrigs = [\"locked\"]\n"
           "cases = 2\n[draw]\nnone = 1\n";
  }
  return {};
}

class VerifyKinds : public Program {};

TEST_F(VerifyKinds, AStudyOfEveryKindIsTheSameToTheLastBitFromOneWorkerAndTwo) {
  for (const KindRow& kind : kinds()) {
    SCOPED_TRACE(kind.id);
    const std::string name(kind.id);
    const std::string text = small_study(kind.id);
    ASSERT_FALSE(text.empty()) << "write a small study of the new kind here";
    folder_.write(name + ".toml", text);
    const Ended first =
        run_program({"run", path(name + ".toml"), "--out", path(name), "--jobs", "2"});
    ASSERT_EQ(first.code, 0) << first.said;
    const Ended verified = run_program({"verify", path(name), "--jobs", "1"});
    EXPECT_EQ(verified.code, 0) << verified.said << verified.result;
    EXPECT_THAT(verified.result, StartsWith("bitwise"));
    EXPECT_THAT(verified.result, HasSubstr("files are as they were written"));
    EXPECT_THAT(run_program({"status", path(name)}).result, HasSubstr("0 failed, 0 running"));
  }
}

}  // namespace
}  // namespace flexspline::studies
