// SPDX-License-Identifier: BSD-3-Clause
// The metrics of quality/metrics.h, for the elements of a page: functions of the corners' coordinates, counter-clockwise
// where the element is valid.
'use strict';

const meshMetrics = (() => {
  const degrees = 180 / Math.PI;
  const length = (x, y) => Math.sqrt(x * x + y * y);

  // Of a triangle: twice its area, and its sides from the shortest to the longest.
  const sides = (ax, ay, bx, by, cx, cy) =>
    [length(bx - ax, by - ay), length(cx - bx, cy - by), length(ax - cx, ay - cy)].sort((p, q) => p - q);
  const doubled = (ax, ay, bx, by, cx, cy) => (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  const triangleShape = (ax, ay, bx, by, cx, cy) => {
    const squares = (bx - ax) ** 2 + (by - ay) ** 2 + (cx - bx) ** 2 + (cy - by) ** 2 + (ax - cx) ** 2 + (ay - cy) ** 2;
    return squares > 0 ? 2 * Math.sqrt(3) * doubled(ax, ay, bx, by, cx, cy) / squares : 0;
  };
  const angleAt = (ax, ay, bx, by, cx, cy) =>
    Math.atan2(Math.abs(doubled(ax, ay, bx, by, cx, cy)), (bx - ax) * (cx - ax) + (by - ay) * (cy - ay)) * degrees;
  const triangleAngles = (ax, ay, bx, by, cx, cy) => doubled(ax, ay, bx, by, cx, cy) === 0
    ? [0, 180]
    : [angleAt(ax, ay, bx, by, cx, cy), angleAt(bx, by, cx, cy, ax, ay), angleAt(cx, cy, ax, ay, bx, by)];

  const triangle = {
    shape: triangleShape,
    area: (...p) => doubled(...p) / 2,
    min_angle: (...p) => Math.min(...triangleAngles(...p)),
    max_angle: (...p) => Math.max(...triangleAngles(...p)),
    aspect_ratio: (...p) => {
      const [l0, l1, l2] = sides(...p);
      return l2 * (l0 + l1 + l2) / (2 * Math.sqrt(3) * Math.abs(doubled(...p)));
    },
    radius_ratio: (...p) => {
      const [l0, l1, l2] = sides(...p);
      return l0 * l1 * l2 * (l0 + l1 + l2) / (4 * doubled(...p) ** 2);
    },
    edge_ratio: (...p) => {
      const [l0, , l2] = sides(...p);
      return l2 / l0;
    },
    condition: (...p) => 1 / triangleShape(...p),
    scaled_jacobian: (...p) => {
      const [, l1, l2] = sides(...p);
      return l1 > 0 ? 2 * doubled(...p) / (Math.sqrt(3) * l1 * l2) : 0;
    },
    equiangle_skew: (...p) => {
      const angles = triangleAngles(...p);
      return Math.max((Math.max(...angles) - 60) / 120, (60 - Math.min(...angles)) / 60, 0);
    },
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
