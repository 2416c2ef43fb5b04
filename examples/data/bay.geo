// A bay with an island, open to the sea in the south. Degrees of longitude and latitude.
Point(1) = {-70.86, 41.30, 0, 0.020};
Point(2) = {-70.52, 41.30, 0, 0.020};
// The shore, from the east around the head of the bay to the west.
Point(3) = {-70.545, 41.385, 0, 0.012};
Point(4) = {-70.60, 41.43, 0, 0.009};
Point(5) = {-70.595, 41.50, 0, 0.007};
Point(6) = {-70.64, 41.57, 0, 0.006};
Point(7) = {-70.685, 41.595, 0, 0.006};
Point(8) = {-70.715, 41.56, 0, 0.006};
Point(9) = {-70.70, 41.50, 0, 0.007};
Point(10) = {-70.755, 41.455, 0, 0.009};
Point(11) = {-70.80, 41.385, 0, 0.012};
Line(1) = {1, 2};
Spline(2) = {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 1};
// The island.
Point(21) = {-70.66, 41.405, 0, 0.006};
Point(22) = {-70.635, 41.42, 0, 0.006};
Point(23) = {-70.648, 41.442, 0, 0.006};
Point(24) = {-70.678, 41.425, 0, 0.006};
Spline(3) = {21, 22, 23, 24, 21};

Curve Loop(1) = {1, 2};
Curve Loop(2) = {3};
Plane Surface(1) = {1, 2};

Physical Curve("open") = {1};
Physical Curve("shore") = {2};
Physical Curve("island") = {3};
Physical Surface("water") = {1};
Mesh.Smoothing = 0;
Mesh.Optimize = 0;
