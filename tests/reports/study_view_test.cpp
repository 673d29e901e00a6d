#include "flexspline/reports/study_view.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flexspline::reports {
namespace {

using testing::ElementsAre;

CaseRecording fitted(std::string id, double amplitude, double frequency, double percent) {
  CaseRecording recording;
  recording.id = std::move(id);
  recording.amplitude = amplitude;
  recording.frequency_hz = frequency;
  recording.rmse_percent = percent;
  return recording;
}

Case case_of(std::string estimator, std::string method, std::vector<std::string> train) {
  Case item;
  item.input = "one";
  item.estimator = std::move(estimator);
  item.method = std::move(method);
  item.train = std::move(train);
  item.recordings = {fitted("large", 0.2, 0.005, 1.0), fitted("small", 0.1, 0.005, 2.0),
                     fitted("slow", 0.2, 0.0025, 3.0), fitted("fast", 0.2, 0.01, 400.0),
                     fitted("again", 0.2, 0.005, 0.5)};
  for (CaseRecording& recording : item.recordings) {
    for (const std::string& id : item.train) recording.trained |= recording.id == id;
  }
  return item;
}

/// Five loops; "again" repeats the operating point; the full trajectory also saw "slow".
Artefacts example() {
  Artefacts artefacts;
  Input input;
  input.id = input.title = "one";
  artefacts.cases = {case_of("full", "trajectory_ceres", {"large", "slow"}),
                     case_of("paper", "midpoint_polynomial", {"large"})};
  for (const CaseRecording& recording : artefacts.cases.front().recordings) {
    InputRecording shown;
    shown.id = recording.id;
    shown.role = recording.trained ? "train" : "holdout";
    shown.amplitude = recording.amplitude;
    shown.frequency_hz = recording.frequency_hz;
    input.recordings.push_back(shown);
  }
  artefacts.inputs = {input};
  return artefacts;
}

std::vector<std::string> ids(const std::vector<const CaseRecording*>& recordings) {
  std::vector<std::string> ids;
  for (const CaseRecording* recording : recordings) ids.push_back(recording->id);
  return ids;
}

TEST(StudyView, FindsThePaperAndTheFullTrajectoryByTheirMethods) {
  const StudyView view(example());
  ASSERT_NE(view.paper_fit(), nullptr);
  EXPECT_EQ(view.paper_fit()->id, "paper");
  ASSERT_NE(view.full_trajectory(), nullptr);
  EXPECT_EQ(view.full_trajectory()->id, "full");
  EXPECT_EQ(view.operating_point(view.artefacts().inputs.front()).recording, "large");
}

TEST(StudyView, JudgesEverybodyOnWhatNobodySaw) {
  const StudyView view(example());
  const Input& input = view.artefacts().inputs.front();
  for (const Case& item : view.artefacts().cases) {
    EXPECT_THAT(ids(view.held_out(input, item)), ElementsAre("small", "fast", "again"));
  }
}

TEST(StudyView, JudgesOnOnesOwnHoldOutWhereEverythingWasSeenBySomebody) {
  Artefacts artefacts = example();
  artefacts.cases.push_back(
      case_of("greedy", "trajectory_ceres", {"small", "fast", "again", "slow"}));
  const StudyView view(std::move(artefacts));
  EXPECT_THAT(ids(view.held_out(view.artefacts().inputs.front(), view.artefacts().cases[1])),
              ElementsAre("small", "slow", "fast", "again"));
}

TEST(StudyView, TellsSmallerAndSlowerFromBeyond) {
  const StudyView view(example());
  const Input& input = view.artefacts().inputs.front();
  const EstimatorView& paper = *view.paper_fit();
  EXPECT_EQ(view.worst(input, paper, Elsewhere::lower_amplitude).percent, 2.0);
  EXPECT_TRUE(std::isnan(view.worst(input, paper, Elsewhere::lower_frequency).percent));
  EXPECT_EQ(view.worst(input, paper, Elsewhere::beyond).percent, 400.0);
  EXPECT_EQ(view.worst(input, paper, Elsewhere::anywhere).where, "0.2 deg, 0.01 Hz");
}

TEST(StudyView, ShowsTheHeldOutTwinOfALoopThatWasRecordedTwice) {
  const StudyView view(example());
  ASSERT_TRUE(view.on_grid());
  const Input& input = view.artefacts().inputs.front();
  std::vector<std::string> places;
  for (const InputRecording* place : view.places(input)) places.push_back(place->id);
  EXPECT_THAT(places, ElementsAre("small", "slow", "again", "fast"));
  EXPECT_EQ(view.at_place(view.artefacts().cases[1], *view.places(input)[2])->id, "again");
}

TEST(StudyView, IsOffTheGridWhereARecordingHasNoFrequency) {
  Artefacts artefacts = example();
  artefacts.inputs.front().recordings.front().frequency_hz = kAbsent;
  const StudyView view(std::move(artefacts));
  EXPECT_FALSE(view.on_grid());
  EXPECT_EQ(view.places(view.artefacts().inputs.front()).size(), 5u);
}

TEST(StudyView, FollowsTheOrderOfTheStudy) {
  Artefacts artefacts = example();
  artefacts.lock =
      "[[study.estimator]]\nid = 'paper'\n[[study.estimator]]\nid = 'full'\n"
      "[[study.input]]\nid = 'two'\n[[study.input]]\nid = 'one'\n";
  Input two;
  two.id = "two";
  artefacts.inputs.push_back(two);
  const StudyView view(std::move(artefacts));
  EXPECT_EQ(view.artefacts().inputs.front().id, "two");
  EXPECT_EQ(view.estimators().front().id, "paper");
}

}  // namespace
}  // namespace flexspline::reports
