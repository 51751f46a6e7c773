#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "command_fixture.h"
#include "isofield/operator_file.h"

namespace isofield {
namespace {

using OperatorCliTest = CommandFixture;

TEST_F(OperatorCliTest, KeepsOperators) {
  write_file(path("my fold.json"), R"({"gradient": {"silhouette": {"kind": "BULGE", "k": 0.5}}})");
  EXPECT_EQ(run("operator put '" + path("my fold.json") + "'"), 0) << err_;
  EXPECT_TRUE(absl::StrContains(out_, "my_fold: version 1")) << out_;
  EXPECT_EQ(run("operator put '" + path("my fold.json") + "' --name other --json"), 0) << err_;
  EXPECT_TRUE(absl::StrContains(out_, "\"name\":\"other\"")) << out_;
  EXPECT_EQ(run("operator ls"), 0);
  EXPECT_TRUE(absl::StartsWith(out_, "NAME                     KIND           FIELDS      VERSION ARGUMENTS\n"))
      << out_;
  EXPECT_TRUE(absl::StrContains(out_, "\nmy_fold ")) << out_;
  EXPECT_EQ(run("operator ls --json"), 0);
  EXPECT_TRUE(absl::StartsWith(out_, R"({"operators":[{"name":)")) << out_;
  EXPECT_EQ(run("operator show other"), 0);
  write_file(path("again.json"), out_);
  const auto shown = read_operator_file(path("again.json"));
  ASSERT_TRUE(shown.ok()) << shown.status();
  EXPECT_EQ(shown->gradient().silhouette().k(), 0.5);
  EXPECT_TRUE(absl::StrContains(err_, "  silhouette.k: a strength within [0, 1], of a bulge only; default: 0\n"))
      << err_;
  EXPECT_EQ(run("operator rm other"), 0);
  EXPECT_EQ(out_, "other: deleted\n");
  EXPECT_EQ(run("operator rm other"), 1);
  EXPECT_TRUE(absl::StrContains(err_, "no operator \"other\"")) << err_;
}

TEST_F(OperatorCliTest, ShowsWhatABuiltInOperatorTakes) {
  EXPECT_EQ(run("operator show ricci"), 0);
  EXPECT_TRUE(absl::StrContains(out_, "{\"ricci\":") && !absl::StrContains(out_, "parameters")) << out_;
  EXPECT_EQ(err_, "Parameters of this kind of operator:\n  exponent: a number within [1, 64]; it must be stated\n");
  EXPECT_EQ(run("operator show ricci --json"), 0);
  EXPECT_EQ(err_, "");
  EXPECT_TRUE(absl::StrContains(
      out_, R"("parameters":[{"name":"exponent","accepts":"a number within [1, 64]","required":true}])"))
      << out_;
}

TEST_F(OperatorCliTest, KeepsTheExample) {
  EXPECT_EQ(run("operator put " ISOFIELD_SOURCE_DIR "/client/examples/operators/fold.json"), 0) << err_;
  EXPECT_TRUE(absl::StrContains(out_, "fold: version 1")) << out_;
}

TEST_F(OperatorCliTest, EvaluatesTables) {
  EXPECT_EQ(run("operator eval gradient --param silhouette=bulge --param K=0.8 --points -",
                "f1,f2,theta,g\n0.25,0.5,0.125,9\n1,0.1,0,9\n"),
            0)
      << err_;
  EXPECT_EQ(out_, "g,dg_df1,dg_df2,dg_dtheta\n0.875,1,1,1\n1.10000002,1,1,1\n");
  EXPECT_EQ(run("operator eval clean --points - -o " + path("o.csv"), "f2,f1\n1,2\n"), 0) << err_;
  EXPECT_EQ(*read_file(path("o.csv")), "g,dg_df1,dg_df2\n3,1,1\n");
  EXPECT_EQ(run("operator eval opening --param preset=camel --points -", "alpha,theta\n1,5\n"), 0) << err_;
  EXPECT_EQ(out_, "theta,dtheta_dalpha\n0.25,0.25\n");
  EXPECT_EQ(run("operator eval clean --points -", "f1,f2\n"), 0) << err_;
  EXPECT_EQ(out_, "g,dg_df1,dg_df2\n") << "a table without rows";
}

TEST_F(OperatorCliTest, LargeTablesGoInSeveralRequests) {
  std::string table = "f1,f2\n";
  for (int i = 0; i < 70'000; ++i) table += "1,2\n";
  EXPECT_EQ(run("operator eval clean --points - -o " + path("o.csv"), table), 0) << err_;
  EXPECT_EQ(read_file(path("o.csv"))->size(), 16u + 70'000u * 6);
  EXPECT_EQ(server_.largest_chunk, Client::kChunkPoints);
  EXPECT_EQ(run("operator eval clean --points - -o " + path("bad.csv"), table + "-1,0\n"), 1);
  EXPECT_TRUE(absl::StrContains(err_, "after 65536 rows: arguments[4464] < 0")) << err_;
  EXPECT_FALSE(read_file(path("bad.csv")).ok());
}

TEST_F(OperatorCliTest, CustomOperatorsTakeParametersToo) {
  write_file(path("fold.json"), R"({"gradient": {"silhouette": {"kind": "BULGE", "k": 0.5}}})");
  ASSERT_EQ(run("operator put " + path("fold.json")), 0) << err_;
  EXPECT_EQ(run("operator eval fold --points -", "f1,f2,alpha\n1,2,3\n"), 0) << err_;
  EXPECT_EQ(run("operator eval fold --param k=0.25 --points -", "f1,f2,alpha\n1,2,3\n"), 0) << err_;
  EXPECT_EQ(run("operator eval fold --param radius=0.25 --points -", "f1,f2,alpha\n1,2,3\n"), 2);
  EXPECT_EQ(run("operator eval none --points -", "f1,f2\n1,2\n"), 1);
}

TEST_F(OperatorCliTest, ErrorsTellWhatIsWrong) {
  EXPECT_EQ(run("operator eval gradient --points -", "f1,f2\n1,2\n"), 4);
  EXPECT_TRUE(absl::StrContains(err_, "<stdin>:1: ") && absl::StrContains(err_, "theta or alpha")) << err_;
  EXPECT_EQ(run("operator eval clean --points -", "f1,f2\n1,2\n1,x\n"), 4);
  EXPECT_TRUE(absl::StrContains(err_, "<stdin>:3: \"x\"")) << err_;
  EXPECT_EQ(run("operator eval opening --points -", "theta\n1\n"), 4);
  EXPECT_EQ(run("operator eval gradient --param k --points -", "f1,f2\n1,2\n"), 2);
  EXPECT_EQ(run("operator eval gradient --param silhouette=round --points -", "f1,f2\n1,2\n"), 2);
  EXPECT_TRUE(absl::StrContains(err_, "smooth, bulge, sampled")) << err_;
  EXPECT_EQ(run("operator eval clean --points " + path("none.csv")), 4);
  EXPECT_EQ(run("operator"), 2);
  write_file(path("bad.json"), "{\"gradient\": {]}");
  EXPECT_EQ(run("operator put " + path("bad.json")), 4);
  EXPECT_TRUE(absl::StrContains(err_, "bad.json:1:") && absl::StrContains(err_, "not an operator")) << err_;
  write_file(path("empty.json"), "{}");
  EXPECT_EQ(run("operator put " + path("empty.json")), 1);
}

TEST_F(OperatorCliTest, DrawsWhereNoFontIsInstalled) {
  const std::string fonts = write_file(path("fonts.conf"), "<fontconfig></fontconfig>");
  ::setenv("FONTCONFIG_FILE", fonts.c_str(), 1);
  for (const char* ending : {".png", ".svg", ".pdf"}) {
    EXPECT_EQ(run(absl::StrCat("operator plot clean --size 64 -o ", path("p"), ending)), 0) << err_;
  }
  ::unsetenv("FONTCONFIG_FILE");
}

TEST_F(OperatorCliTest, DrawsOperatorsAndOpenings) {
  for (const char* name : {"gradient", "gradient --theta 0,45", "gradient --alpha 90", "clean",
                           "bt2 --param r1=1 --param r2=2", "opening", "opening --param preset=contact"}) {
    EXPECT_EQ(run(std::string("operator plot ") + name + " --size 64 -o " + path("p.png")), 0) << name << err_;
    EXPECT_EQ(read_file(path("p.png"))->substr(1, 3), "PNG");
  }
  for (const auto& [ending, start] : {std::pair(".png", "\x89PNG"), {".svg", "<?xml"}, {".pdf", "%PDF-"}}) {
    for (const char* name : {"p", "again"}) {
      EXPECT_EQ(run(absl::StrCat("operator plot clean --size 64 -o ", path(name), ending)), 0) << err_;
    }
    const std::string plot = *read_file(path("p") + ending);
    EXPECT_TRUE(absl::StartsWith(plot, start)) << ending;
    EXPECT_EQ(*read_file(path("again") + ending), plot) << "the same bytes each time";
  }
  EXPECT_EQ(run("operator plot clean --theta 10 -o " + path("q.png")), 2);
  EXPECT_EQ(run("operator plot gradient --theta 46 -o " + path("q.png")), 2);
  EXPECT_EQ(run("operator plot gradient --theta 1 --alpha 1 -o " + path("q.png")), 2);
  EXPECT_EQ(run("operator plot gradient -o " + path("q.jpg")), 2);
  const int reads = server_.reads;
  EXPECT_EQ(run("operator plot gradient -o /no/such/directory/q.png"), 4);
  EXPECT_EQ(run("operator eval clean --points - -o /no/such/directory/q.csv", "f1,f2\n1,2\n"), 4);
  EXPECT_EQ(server_.reads, reads) << "before anything is asked for";
}

TEST_F(OperatorCliTest, PicksOpenings) {
  write_file(path("s.json"), R"({"nodes": [{"sphere": {"radius": 1, "range": 1}}]})");
  EXPECT_EQ(run("operator pick " + path("s.json") + " top 20 -30.5 0.5"), 0) << err_;
  EXPECT_EQ(out_, "theta = 20 at alpha = -30.5 degrees; f1 = 0.5, f2 = 0\n");
  EXPECT_EQ(run("operator pick " + path("s.json") + " top 20 -.5 .25"), 0) << err_;
  EXPECT_EQ(out_, "theta = 20 at alpha = -0.5 degrees; f1 = 0.25, f2 = 0\n");
  EXPECT_EQ(run("operator pick none top 1 2 3"), 1);
  EXPECT_EQ(run("operator pick " + path("s.json") + " top 1 2"), 2);
}

}  // namespace
}  // namespace isofield
