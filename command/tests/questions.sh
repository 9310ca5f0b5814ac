# questions: fifty that players ask, as they type them first, and the lines that answer.
ask() {
  number=$1 lines=$2
  shift 2
  echo "$number. carom $*"
  carom "$@" 2>&1 | grep -E "$lines" || echo "no answer"
}
ask 1 squirt shoot --tip 0.25,0 --with end_mass=7g,3g
ask 2 throw: hit --cut full --side 5%
ask 3 , hit --cut 0,30,45,60 --spin roll --quantity distance
ask 4 rests: hit --cut full --spin rolling --speed medium
ask 5 'cue .*rests' shoot --cue 2d,2d --balls 2d,4d --at-ball 1 --tip low --speed firm --cue-ball mass=5.5oz,6oz
ask 6 '^1|rail' shoot --cue 2d,4d --balls left,6d --at-ball 1 --cut thin --speed 2
ask 7 'the left rail' shoot --cue 1d,2d --to right,3d --speed 1.5,2.5,4 --csv
ask 8 'rolling: .*right' hit --cut half-ball --spin screw --restitution 1,0.95
ask 9 'rests' shoot --elevation 10 --tip right --speed slow,medium,fast
ask 10 'from x = 0.635, y = 0.635|lands 1' shoot --elevation 40deg --speed 10mph --tip center
ask 11 'meets the' shoot --table 10ft --cue head-left --to right,3d --tip 1tip,0.5tip --speed 3
ask 12 'meets the' shoot --table 3-cushion --cue left,0.5d --to right,3d --tip 1tip,0.5tip --speed 3
ask 13 'meets the' shoot --table carom --cue 1d,1d --to 2d,8d --tip 1tip,0
for cue in 1d,2d 2d,2d; do ask 14 'make a ball' break --rules nineball --cue $cue --speed break --racks 100; done
ask 15 'foot-right|^  1 ' break --rack 9-ball --speed 20mph --racks 100 --falls
ask 16 'make|most' break --rules nineonspot --speed 22mph --racks 100
ask 17 'make|fouls' break --rules 9-ball --speed 12mph --cue 1d,2d --cut 10 --racks 100
for table in 7ft 9ft; do ask 18 'either jaw' shoot --table $table,corner=4.25in --cue 1d,2d --balls 2d,5d --pocket 1:foot-right; done
ask 19 'foot-right, pot|side' ways --cue 2d,1d --balls 2d,6d:3.5d,5d --rails 0 --player 500
ask 20 pot ways --cue 2d,2d --balls 1d,6d:3d,5d:2d,7d --rails 0 --player 600
ask 21 '^1|chances|potting' plan --cue 2d,2d --balls 1=1d,6d:9=3d,5d --shots 300
ask 22 , rail --angle 0:80:20 --side running --quantity rebound
ask 23 , rail --angle 60 --speed 1,2,4,7mph --quantity rebound
ask 24 'meets|rests' shoot --cue 2d,0.5d --speed 7mph
ask 25 'rests' shoot --cue 2d,1d --tip 0,0.5tip:0,1tip:high --speed medium
for cloth in slow-cloth fast-cloth; do ask 26 rests shoot --cue 2d,1d --speed 3 --with $cloth; done
ask 27 'touch|frozen|meets|tip' shoot --cue 2d,2d --balls 1=frozen-cue,90,0.5in --elevation 20 --speed medium
ask 28 '^2 ' shoot --cue 2d,2d --balls 2d,4d:2=frozen-1,90,0.25in --at-ball 1 --cut 10 --speed slow,medium,fast
ask 29 bridge shoot --tip 50%,0 --with end_mass=5g
ask 30 'cue .*rests|falls|^aim' shoot --table 12ft --cue brown --balls blue --at-ball blue --pocket blue:top-right --tip low
ask 31 'a game|to 7' odds --players 550,620 --race 7
printf 'against,won,lost\n520,9,7\n610,3,9\n' | ask 32 rating rating -
ask 33 '^1|chances' plan --only safeties --cue 2d,2d --balls 1=1d,6d:9=3d,5d --rules nineball --shots 300
ask 34 'meets 2' shoot --balls onepocket --speed 8
ask 35 'white .*table|meets red' shoot --table 10ft --cue white=0.6,0.8 \
  --balls yellow=0.8,1.9:red=0.5,2 --at-ball red --speed 2
ask 36 '^1' plan --rules straightrail --cue 0.6,0.8 --balls 0.8,1.9:0.4,1 --shots 300
ask 37 'a cut' shoot --cue 0.6,0.8 --balls 0.8,1.9:0.72,1.6 --at-ball 1 --cut -70,0,60 --speed 2
ask 38 'not on the table' shoot --cue 0.6,0.8 --balls 0.8,3.9 --at-ball 1 --speed 2
ask 39 'meets 1|rests' shoot --cue 2d,2d --balls 1=frozen-cue,90,1m --at-ball 1 --tip draw --speed 3
ask 40 ^ shoot --cue 2d,1d --speed 3 --cloth slow,fast --cushions old,new
ask 41 '^[0-9]' shoot --cue 2d,1d --with M=18oz,21oz
ask 42 '^[1-3]|wins' plan --rules straight --balls straight:1=3d,5.5d --cue 1.5d,4.5d --shots 300 --player 600
ask 43 opening break --rules straight-pool
ask 44 in-hand shoot --cue kitchen
ask 45 leave shoot --speed lag
ask 45 '^leave' shoot --cue 1d,2d --leave 1d,0.2d
ask 46 , hit --cut 45 --side outside,inside,none --quantity throw
ask 47 '[-]-side' rail --spin left
ask 48 beginner ways --player beginner --balls 1=2d,4d
ask 49 '^r|^f' calibrate --banks 4.8,5.8,5.6
ask 50 elevation shoot --balls 1=2d,2d --jump
ask 50 'passes|flies|lands' shoot --cue 2d,1d --balls 1=2d,2d --elevation 40 --speed 4
