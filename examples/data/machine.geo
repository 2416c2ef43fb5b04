// One pole (45 degrees) of a permanent-magnet synchronous machine with 8 poles and 48 slots: shaft, laminated rotor
// with a buried magnet between two air pockets, air gap in two layers with the sliding circle between them, stator with
// six slots of distributed winding. Millimetres.

shaft_radius = 28;
rotor_radius = 80.0;
gap = 0.9;
stator_radius = rotor_radius + gap;
outer_radius = 128;
pole = Pi / 4;
slots = 6;
slot_pitch = pole / slots;

opening = 1.1;       // half the slot opening
tip = 1.2;           // depth of the tooth tips
wedge = 2.6;         // radial place of the slot's shoulder above the bore
slot_depth = 24;
shoulder = 2.5;      // half the slot's width at its shoulder
bottom = 3.9;        // half its width at its bottom

gap_size = 0.62;
slot_size = 1.5;
magnet_size = 1.8;
yoke_size = 4.2;
shaft_size = 5.5;

Point(1) = {0, 0, 0, shaft_size};

// A call has to end its line: the parser resumes at the next one.
// A point at the polar place (radius, angle) moved sideways by `aside`.
Macro Polar
  made = newp;
  Point(made) = {radius * Cos(angle) - aside * Sin(angle), radius * Sin(angle) + aside * Cos(angle), 0, size};
Return

// ---- Radial points on both cut faces.
aside = 0;
For face In {0:1}
  angle = face * pole;
  radius = shaft_radius; size = shaft_size;
  Call Polar;
  shaft_point[face] = made;
  radius = rotor_radius; size = gap_size;
  Call Polar;
  rotor_point[face] = made;
  radius = rotor_radius + gap / 2;
  Call Polar;
  slide_point[face] = made;
  radius = stator_radius;
  Call Polar;
  bore_point[face] = made;
  radius = outer_radius; size = yoke_size;
  Call Polar;
  outer_point[face] = made;
EndFor

For face In {0:1}
  l = newl; Line(l) = {1, shaft_point[face]}; shaft_cut[face] = l;
  l = newl; Line(l) = {shaft_point[face], rotor_point[face]}; rotor_cut[face] = l;
  l = newl; Line(l) = {rotor_point[face], slide_point[face]}; inner_gap_cut[face] = l;
  l = newl; Line(l) = {slide_point[face], bore_point[face]}; outer_gap_cut[face] = l;
  l = newl; Line(l) = {bore_point[face], outer_point[face]}; stator_cut[face] = l;
EndFor
shaft_arc = newl; Circle(shaft_arc) = {shaft_point[0], 1, shaft_point[1]};
rotor_arc = newl; Circle(rotor_arc) = {rotor_point[0], 1, rotor_point[1]};
slide_arc = newl; Circle(slide_arc) = {slide_point[0], 1, slide_point[1]};
outer_arc = newl; Circle(outer_arc) = {outer_point[0], 1, outer_point[1]};

// ---- The magnet and its air pockets, about the pole's axis.
angle = pole / 2;
size = magnet_size;
inner = 63.5; thick = 6.2; half = 17.5; pocket = 4.6;
radius = inner; aside = -half;
Call Polar;
m1 = made;
radius = inner + thick;
Call Polar;
m2 = made;
aside = half;
Call Polar;
m3 = made;
radius = inner;
Call Polar;
m4 = made;
size = 0.9;
radius = inner + 1.2; aside = -half - pocket;
Call Polar;
q1 = made;
radius = inner + thick + 3.8; aside = -half - pocket - 1.6;
Call Polar;
q2 = made;
radius = inner + thick + 4.6; aside = -half - 2.6;
Call Polar;
q3 = made;
radius = inner + 1.2; aside = half + pocket;
Call Polar;
q4 = made;
radius = inner + thick + 3.8; aside = half + pocket + 1.6;
Call Polar;
q5 = made;
radius = inner + thick + 4.6; aside = half + 2.6;
Call Polar;
q6 = made;
l = newl;
Line(l) = {m4, m1};
Line(l + 1) = {m1, m2};
Line(l + 2) = {m2, m3};
Line(l + 3) = {m3, m4};
Line(l + 4) = {m1, q1};
Line(l + 5) = {q1, q2};
Line(l + 6) = {q2, q3};
Line(l + 7) = {q3, m2};
Line(l + 8) = {m4, q4};
Line(l + 9) = {q4, q5};
Line(l + 10) = {q5, q6};
Line(l + 11) = {q6, m3};
magnet_loop = newll; Curve Loop(magnet_loop) = {l, l + 1, l + 2, l + 3};
magnet = news; Plane Surface(magnet) = {magnet_loop};
pocket_loop = newll; Curve Loop(pocket_loop) = {l + 4, l + 5, l + 6, l + 7, -(l + 1)};
pocket_right = news; Plane Surface(pocket_right) = {pocket_loop};
pocket_loop = newll; Curve Loop(pocket_loop) = {l + 8, l + 9, l + 10, l + 11, l + 3};
pocket_left = news; Plane Surface(pocket_left) = {pocket_loop};
hole_loop = newll;
Curve Loop(hole_loop) = {l, l + 4, l + 5, l + 6, l + 7, l + 2, -(l + 11), -(l + 10), -(l + 9), -(l + 8)};

loop = newll; Curve Loop(loop) = {shaft_cut[0], shaft_arc, -shaft_cut[1]};
shaft = news; Plane Surface(shaft) = {loop};
loop = newll; Curve Loop(loop) = {rotor_cut[0], rotor_arc, -rotor_cut[1], -shaft_arc};
rotor = news; Plane Surface(rotor) = {loop, hole_loop};
loop = newll; Curve Loop(loop) = {inner_gap_cut[0], slide_arc, -inner_gap_cut[1], -rotor_arc};
inner_gap = news; Plane Surface(inner_gap) = {loop};

// ---- Slots. `bore_arcs` is the bore with the slot openings closed, `steel_rim` the stator's edge around the slots.
bore_arcs[] = {};
steel_rim[] = {};
wedges[] = {};
coils[] = {};
from = bore_point[0];
For slot In {0:slots - 1}
  angle = (slot + 0.5) * slot_pitch;
  size = gap_size;
  foot = Sqrt(stator_radius * stator_radius - opening * opening);
  radius = foot; aside = -opening;
  Call Polar;
  s1 = made;
  aside = opening;
  Call Polar;
  s2 = made;
  radius = stator_radius + tip;
  Call Polar;
  s4 = made;
  aside = -opening;
  Call Polar;
  s3 = made;
  size = slot_size;
  radius = stator_radius + wedge; aside = -shoulder;
  Call Polar;
  s5 = made;
  aside = shoulder;
  Call Polar;
  s6 = made;
  radius = stator_radius + slot_depth - bottom; aside = -bottom;
  Call Polar;
  s7 = made;
  aside = bottom;
  Call Polar;
  s8 = made;
  aside = 0;
  Call Polar;
  s9 = made;
  radius = stator_radius + slot_depth;
  Call Polar;
  s10 = made;

  l = newl;
  Circle(l) = {from, 1, s1};
  Circle(l + 1) = {s1, 1, s2};
  Line(l + 2) = {s1, s3};
  Line(l + 3) = {s3, s5};
  Line(l + 4) = {s5, s7};
  Circle(l + 5) = {s7, s9, s10};
  Circle(l + 6) = {s10, s9, s8};
  Line(l + 7) = {s8, s6};
  Line(l + 8) = {s6, s4};
  Line(l + 9) = {s4, s2};
  Line(l + 10) = {s5, s6};
  bore_arcs[] += {l, l + 1};
  steel_rim[] += {l, l + 2, l + 3, l + 4, l + 5, l + 6, l + 7, l + 8, l + 9};
  loop = newll; Curve Loop(loop) = {l + 1, -(l + 9), -(l + 8), -(l + 10), -(l + 3), -(l + 2)};
  s = news; Plane Surface(s) = {loop}; wedges[] += {s};
  loop = newll; Curve Loop(loop) = {l + 10, -(l + 7), -(l + 6), -(l + 5), -(l + 4)};
  s = news; Plane Surface(s) = {loop}; coils[] += {s};
  from = s2;
EndFor
l = newl; Circle(l) = {from, 1, bore_point[1]};
bore_arcs[] += {l};
steel_rim[] += {l};

loop = newll;
Curve Loop(loop) = {outer_gap_cut[0], bore_arcs[], -outer_gap_cut[1], -slide_arc};
outer_gap = news; Plane Surface(outer_gap) = {loop};
reversed[] = {};
For i In {#steel_rim[] - 1:0:-1}
  reversed[] += {-steel_rim[i]};
EndFor
loop = newll;
Curve Loop(loop) = {stator_cut[0], outer_arc, -stator_cut[1], reversed[]};
stator = news; Plane Surface(stator) = {loop};

Physical Surface("shaft", 1) = {shaft};
Physical Surface("rotor steel", 2) = {rotor};
Physical Surface("magnet", 3) = {magnet};
Physical Surface("air pockets", 4) = {pocket_right, pocket_left};
Physical Surface("air gap, rotor side", 5) = {inner_gap};
Physical Surface("air gap, stator side, and slot openings", 6) = {outer_gap, wedges[]};
Physical Surface("winding, phase A", 7) = {coils[0], coils[1]};
Physical Surface("winding, phase C", 8) = {coils[2], coils[3]};
Physical Surface("winding, phase B", 9) = {coils[4], coils[5]};
Physical Surface("stator steel", 10) = {stator};

Mesh.Algorithm = 1;  // MeshAdapt
Mesh.Smoothing = 0;
Mesh.Optimize = 0;
