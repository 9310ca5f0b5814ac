class Carom < Formula
  desc "Billiards: collisions of balls and cushions, whole shots"
  homepage "@HOMEPAGE@"
  url "@ARCHIVE@"
  sha256 "@SHA256@"
  license "Apache-2.0"

  depends_on "cmake" => :build

  def install
    # The command is for Linux.
    system "cmake", "-S", ".", "-B", "build", "-DCAROM_CLI=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    (testpath/"test.c").write <<~C
      #include <carom_shot.h>
      int main(void) {
        static carom_event events[600];
        static carom_shot shot = {.events = events, .room = 600};
        static carom_shot_ball balls[10];
        carom_table table;
        carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
        cue.speed = 8;
        carom_table_make(CAROM_TABLE_POOL_9FT, &table);
        carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, balls, 10);
        return carom_shoot(&table, balls, 10, &cue, NULL, &shot) != CAROM_OK || shot.count < 20;
      }
    C
    system ENV.cc, "test.c", "-I#{include}", "-L#{lib}", "-lcarom", "-o", "test"
    system "./test"
  end
end
