#include "tables/builder.hpp"

#include <gmock/gmock.h>

#include <array>

#include "tables/reader.hpp"

namespace tables {
namespace {

using ::testing::ElementsAre;

enum class Colour { red, green };
constexpr std::array<std::string_view, 2> colour_names{"red", "green"};
std::span<const std::string_view> names_of(Colour) {
  return colour_names;
}

struct Corner {
  Corner(double x, double y) : at{x, y} {}
  [[nodiscard]] double x() const { return at[0]; }
  [[nodiscard]] double y() const { return at[1]; }
  std::array<double, 2> at;
};

struct Paint {
  double shade = 0.5;
};
struct Sheet {
  std::string name;
  Colour colour = Colour::red;
  std::vector<Colour> dots;
  std::vector<Corner> outline;
  std::optional<int> layers;
  Paint paint;
};
struct Press {
  double tilt = 0.0;  // [turns]
  bool on = true;
};
struct Shop {
  std::string title = "none";
  Press press;
  std::vector<Sheet> sheets;
};

constexpr double degree = 1.0 / 360.0;

std::vector<Table<Shop>> shop_tables() {
  return {TableBuilder<Shop, Shop>("a shop").key("title", &Shop::title, {}).build(),
          TableBuilder<Shop, Press>("press", &Shop::press, "a press")
              .key("tilt", &Press::tilt, {.range = at_least(0.0)})
              .in(degree)
              .key("on", &Press::on, {})
              .build(),
          TableBuilder<Shop, Sheet>("sheet", &Shop::sheets, "a sheet")
              .required()
              .key("name", &Sheet::name, {.need = Need::required})
              .key("colour", &Sheet::colour, {})
              .key("dots", &Sheet::dots, {.need = Need::optional})
              .key("outline", &Sheet::outline, {.need = Need::optional})
              .key("layers", &Sheet::layers, {.need = Need::optional})
              .key("shade", [](auto& sheet) -> auto& { return sheet.paint.shade; }, {})
              .build()};
}

Shop read(std::string_view text, std::vector<std::string> settings, Diagnosis& diagnosis) {
  Shop shop;
  EXPECT_FALSE(read_tables(text, settings, shop_tables(), shop, diagnosis));
  return shop;
}

TEST(TableBuilder, ServesAnyStruct) {
  Diagnosis diagnosis("shop.toml");
  const Shop shop = read(R"(title = "Ink"
[press]
tilt = 90
[[sheet]]
name = "a"
[[sheet]]
name = "b"
colour = "green"
dots = ["green", "red"]
outline = [[0, 1], [2.5, 3]]
layers = 3
shade = 0.25
)",
                         {}, diagnosis);
  EXPECT_TRUE(diagnosis.errors().empty());
  EXPECT_EQ(shop.title, "Ink");
  EXPECT_EQ(shop.press.tilt, 0.25);
  EXPECT_TRUE(shop.press.on);
  ASSERT_EQ(shop.sheets.size(), 2U);
  EXPECT_EQ(shop.sheets[0].colour, Colour::red);
  EXPECT_FALSE(shop.sheets[0].layers);
  EXPECT_EQ(shop.sheets[0].paint.shade, 0.5);
  const Sheet& b = shop.sheets[1];
  EXPECT_EQ(b.colour, Colour::green);
  EXPECT_THAT(b.dots, ElementsAre(Colour::green, Colour::red));
  ASSERT_EQ(b.outline.size(), 2U);
  EXPECT_THAT(b.outline[1].at, ElementsAre(2.5, 3.0));
  EXPECT_EQ(b.layers, 3);
  EXPECT_EQ(b.paint.shade, 0.25);
}

TEST(TableBuilder, ReadsBackWhatItWrote) {
  Diagnosis diagnosis("shop.toml");
  const std::string text =
      "[press]\ntilt = 90.0\non = false\n[[sheet]]\nname = \"b\"\ncolour = "
      "\"green\"\ndots = [\"green\"]\noutline = [0.0, 1.0]\nlayers = 3\nshade "
      "= 0.25\n";
  Shop shop = read(
      "[press]\ntilt = 90\non = false\n[[sheet]]\nname = \"b\"\ncolour = \"green\"\n"
      "dots = \"green\"\noutline = [[0, 1]]\nlayers = 3\nshade = 0.25\n",
      {}, diagnosis);
  std::string printed;
  for (const Table<Shop>& table : shop_tables()) {
    if (table.name.empty()) continue;
    EXPECT_EQ(table.size(shop), 1U);
    printed += table.title() + "\n";
    for (const Field<Shop>& field : table.fields) {
      const auto value = field.read(shop, 0);
      ASSERT_TRUE(value) << field.key;
      printed += std::string(field.key) + " = " + value_text(*value) + "\n";
    }
  }
  EXPECT_EQ(printed, text);
}

TEST(TableBuilder, SaysWhatIsAbsent) {
  Diagnosis diagnosis("shop.toml");
  const Shop shop = read("[[sheet]]\nname = \"a\"\n", {}, diagnosis);
  const auto tables = shop_tables();
  for (const char* key : {"dots", "outline", "layers"}) {
    EXPECT_FALSE(tables[2].find(key)->read(shop, 0)) << key;
  }
}

TEST(TableBuilder, RefusesByFileLineAndKey) {
  Diagnosis diagnosis("shop.toml");
  (void)read("[press]\ntilt = -1\n[[sheet]]\nname = \"a\"\ncolour = \"grene\"\noutline = [[1]]\n",
             {"sheet.a.layers=x", "press.off=true"}, diagnosis);
  std::vector<std::string> texts;
  for (const Complaint& complaint : diagnosis.errors()) texts.push_back(complaint.text());
  EXPECT_THAT(
      texts,
      ::testing::UnorderedElementsAre(
          "--set sheet.a.layers=x: sheet.0.layers: found `x`, which is no TOML value; allowed is a "
          "whole number",
          "--set press.off=true: press.off: no such key; keys of [press] are tilt, on",
          "shop.toml:2:8: press.tilt: found -1; allowed is a number >= 0",
          "shop.toml:5:10: sheet.0.colour: found the text \"grene\"; allowed is one of red, green; "
          "did you mean \"green\"?",
          "shop.toml:6:11: sheet.0.outline: found [1]; allowed is a list of points [x, y] and "
          "arcs"));
}

}  // namespace
}  // namespace tables
