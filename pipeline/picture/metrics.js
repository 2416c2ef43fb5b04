// SPDX-License-Identifier: BSD-3-Clause
// The metrics of quality/metrics.h, for the elements of a page: functions of the corners' coordinates, counter-clockwise
// where the element is valid.
const meshMetrics = (() => {
  const degrees = 180 / Math.PI;
  const length = (x, y) => Math.sqrt(x * x + y * y);

  // Of a triangle: twice its area, and its sides. (Pages have millions: no arrays are made for each.)
  const doubled = (ax, ay, bx, by, cx, cy) => (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  const shortest = (ax, ay, bx, by, cx, cy) => Math.min(length(bx - ax, by - ay), length(cx - bx, cy - by), length(ax - cx, ay - cy));
  const longest = (ax, ay, bx, by, cx, cy) => Math.max(length(bx - ax, by - ay), length(cx - bx, cy - by), length(ax - cx, ay - cy));
  const around = (ax, ay, bx, by, cx, cy) => length(bx - ax, by - ay) + length(cx - bx, cy - by) + length(ax - cx, ay - cy);
  const triangleShape = (ax, ay, bx, by, cx, cy) => {
    const squares = (bx - ax) * (bx - ax) + (by - ay) * (by - ay) + (cx - bx) * (cx - bx) + (cy - by) * (cy - by) +
      (ax - cx) * (ax - cx) + (ay - cy) * (ay - cy);
    return squares > 0 ? 2 * Math.sqrt(3) * doubled(ax, ay, bx, by, cx, cy) / squares : 0;
  };
  const angleAt = (ax, ay, bx, by, cx, cy) =>
    Math.atan2(Math.abs(doubled(ax, ay, bx, by, cx, cy)), (bx - ax) * (cx - ax) + (by - ay) * (cy - ay)) * degrees;
  const smallestAngle = (ax, ay, bx, by, cx, cy) => doubled(ax, ay, bx, by, cx, cy) === 0 ? 0
    : Math.min(angleAt(ax, ay, bx, by, cx, cy), angleAt(bx, by, cx, cy, ax, ay), angleAt(cx, cy, ax, ay, bx, by));
  const largestAngle = (ax, ay, bx, by, cx, cy) => doubled(ax, ay, bx, by, cx, cy) === 0 ? 180
    : Math.max(angleAt(ax, ay, bx, by, cx, cy), angleAt(bx, by, cx, cy, ax, ay), angleAt(cx, cy, ax, ay, bx, by));

  const triangle = {
    shape: triangleShape,
    area: (ax, ay, bx, by, cx, cy) => doubled(ax, ay, bx, by, cx, cy) / 2,
    min_angle: smallestAngle,
    max_angle: largestAngle,
    aspect_ratio: (ax, ay, bx, by, cx, cy) => longest(ax, ay, bx, by, cx, cy) * around(ax, ay, bx, by, cx, cy) /
      (2 * Math.sqrt(3) * Math.abs(doubled(ax, ay, bx, by, cx, cy))),
    radius_ratio: (ax, ay, bx, by, cx, cy) =>
      length(bx - ax, by - ay) * length(cx - bx, cy - by) * length(ax - cx, ay - cy) * around(ax, ay, bx, by, cx, cy) /
      (4 * doubled(ax, ay, bx, by, cx, cy) ** 2),
    edge_ratio: (ax, ay, bx, by, cx, cy) => longest(ax, ay, bx, by, cx, cy) / shortest(ax, ay, bx, by, cx, cy),
    condition: (ax, ay, bx, by, cx, cy) => 1 / triangleShape(ax, ay, bx, by, cx, cy),
    scaled_jacobian: (ax, ay, bx, by, cx, cy) => {
      // Twice the area by the two longer sides.
      const all = length(bx - ax, by - ay) * length(cx - bx, cy - by) * length(ax - cx, ay - cy);
      const least = shortest(ax, ay, bx, by, cx, cy);
      return all > 0 ? 2 * doubled(ax, ay, bx, by, cx, cy) / (Math.sqrt(3) * (all / least)) : 0;
    },
    equiangle_skew: (ax, ay, bx, by, cx, cy) => Math.max((largestAngle(ax, ay, bx, by, cx, cy) - 60) / 120,
      (60 - smallestAngle(ax, ay, bx, by, cx, cy)) / 60, 0),
  };

  // Of a quadrilateral, for each corner: what the sides that leave it have as cross product, lengths and angle.
  const corners = (...p) => {
    const sense = quadArea(...p) < 0 ? -1 : 1;
    return [0, 1, 2, 3].map((i) => {
      const [x, y] = [p[2 * i], p[2 * i + 1]];
      const [outX, outY] = [p[(2 * i + 2) % 8] - x, p[(2 * i + 3) % 8] - y];
      const [inX, inY] = [p[(2 * i + 6) % 8] - x, p[(2 * i + 7) % 8] - y];
      const cross = outX * inY - outY * inX;
      const acute = Math.atan2(Math.abs(cross), outX * inX + outY * inY) * degrees;
      return {cross, out: length(outX, outY), back: length(inX, inY), angle: sense * cross < 0 ? 360 - acute : acute};
    });
  };
  const quadArea = (ax, ay, bx, by, cx, cy, dx, dy) => ((cx - ax) * (dy - by) - (cy - ay) * (dx - bx)) / 2;
  const corner = (x, y, nextX, nextY, lastX, lastY) => {
    const outX = nextX - x;
    const outY = nextY - y;
    const inX = lastX - x;
    const inY = lastY - y;
    const squares = outX * outX + outY * outY + inX * inX + inY * inY;
    return squares > 0 ? 2 * (outX * inY - outY * inX) / squares : 0;
  };
  const quadShape = (ax, ay, bx, by, cx, cy, dx, dy) =>
    Math.min(corner(ax, ay, bx, by, dx, dy), corner(bx, by, cx, cy, ax, ay), corner(cx, cy, dx, dy, bx, by),
             corner(dx, dy, ax, ay, cx, cy));
  const quadAngles = (...p) => {
    const all = corners(...p);
    const angles = all.map((at) => at.angle);
    const most = Math.max(...angles);
    const has = quadArea(...p) !== 0 && all.every((at) => at.out > 0);
    return [has ? Math.min(...angles) : 0, has || most > 180 ? most : 180];
  };
  // Twice the lines through the middles of opposite sides.
  const middles = (ax, ay, bx, by, cx, cy, dx, dy) => [bx - ax + cx - dx, by - ay + cy - dy, cx - bx + dx - ax, cy - by + dy - ay];

  const quadrilateral = {
    shape: quadShape,
    area: quadArea,
    min_angle: (...p) => quadAngles(...p)[0],
    max_angle: (...p) => quadAngles(...p)[1],
    aspect_ratio: (...p) => {
      const lengths = corners(...p).map((at) => at.out);
      return Math.max(...lengths) * lengths.reduce((sum, l) => sum + l) / (4 * Math.abs(quadArea(...p)));
    },
    edge_ratio: (...p) => {
      const lengths = corners(...p).map((at) => at.out);
      return Math.max(...lengths) / Math.min(...lengths);
    },
    condition: (...p) => 1 / quadShape(...p),
    scaled_jacobian: (...p) => Math.min(...corners(...p).map((at) => at.out * at.back > 0 ? at.cross / (at.out * at.back) : 0)),
    equiangle_skew: (...p) => {
      const [least, most] = quadAngles(...p);
      return Math.min(Math.max((most - 90) / 90, (90 - least) / 90, 0), 1);
    },
    skew: (...p) => {
      const [ux, uy, vx, vy] = middles(...p);
      const lengths = length(ux, uy) * length(vx, vy);
      return lengths > 0 ? Math.min(Math.abs(ux * vx + uy * vy) / lengths, 1) : 1;
    },
    taper: (...p) => {
      const [ux, uy, vx, vy] = middles(...p);
      return length(p[0] - p[2] + p[4] - p[6], p[1] - p[3] + p[5] - p[7]) / Math.min(length(ux, uy), length(vx, vy));
    },
  };
  return {triangle, quadrilateral};
})();
