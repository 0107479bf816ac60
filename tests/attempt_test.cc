// A part that a result can do without may fail in any way: it is a shortfall, and reported once.
#include "rollwave/run/attempt.h"

#include "rollwave/base/errors.h"
#include "rollwave/run/simulation.h"
#include "test_scenes.h"

#include <deal.II/lac/exceptions.h>

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

using namespace rollwave;
using dealii::LACExceptions::ExcSingular;

namespace {

TEST(Attempt, MakesEveryFailureAShortfall) {
  const auto shortfalls_of = [](const std::function<void()>& compute) {
    std::vector<Note> notes;
    attempt(compute, "a part is missing", "change a", MPI_COMM_SELF, notes);
    for (const Note& note : notes)
      EXPECT_EQ(note.text.find('\n'), std::string::npos) << note.text;
    return texts_of(notes, Note::Kind::shortfall).size();
  };
  EXPECT_EQ(shortfalls_of([] {}), 0u);
  EXPECT_EQ(shortfalls_of([] { throw NotSolved("no convergence"); }), 1u);
  EXPECT_EQ(shortfalls_of([] { throw NotEnoughMemory(); }), 1u);
  EXPECT_EQ(shortfalls_of([] { throw std::bad_alloc(); }), 1u);
  EXPECT_EQ(shortfalls_of([] { throw std::runtime_error("any"); }), 1u);
  EXPECT_EQ(shortfalls_of([] { AssertThrow(false, ExcSingular()); }), 1u);
}

/// Figure 4 without a certificate, since its road has no slope.
Result without_certificate(const std::vector<std::string>& settings) {
  const Parameters parameters = with(parameters_of({"Mesh/Angular cells=400"}), settings);
  Scene scene = make_scene(parameters);
  scene.phi.slope = [](double) -> double { throw ExcSingular(); };
  return simulate(scene, parameters).result;
}

TEST(Attempt, FailingCertificateLeavesTheSolution) {
  for (const std::string setting :
       {"Certificate/Error bound=true", "Mesh/Wanted relative error=1e-3"}) {
    const Result result =
        without_certificate({setting, "Mesh/Indicator=kelly", "Mesh/Most unknowns=30000"});
    EXPECT_EQ(texts_of(result.notes, Note::Kind::shortfall).size(), 1u) << setting;
    EXPECT_FALSE(result.certified);
    EXPECT_NEAR(result.contact.loads.total, 0.33249897643, 1e-4);
    EXPECT_NEAR(result.energy.value, 0.02906970811, 1e-5);
  }
}

} // namespace
