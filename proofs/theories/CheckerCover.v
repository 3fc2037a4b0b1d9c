(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The fourth part of the checker of certificates: pairs of sites that are not surrounded. The plane of centres, with its
   points at infinity, is cut into triangles until none holds the centres of two sites whose pair is not listed.
   CheckerCoverSound.v says what follows: such a pair is illegal. How to cut is a hint of any origin. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerFaces.
Import ListNotations.
Open Scope Z_scope.

(* The centre (sx/sw, sy/sw); when sw is 0, the one at infinity in direction (sx,sy). *)
Record spot : Type := Spot { sx : Z; sy : Z; sw : Z }.

(* Where to cut a triangle: the side (0: ab, 1: bc, else: ca), and a point of it, the sum of its ends by two weights over
   a divisor. *)
Record cutting : Type := Cutting { side : Z; weight : Z; other_weight : Z; divisor : Z; middle : spot }.

(* A site that may be possible somewhere, and whether its pairs are looked for. *)
Record candidate : Type := Candidate { area : box; sought : bool }.

(* Fewer digits: a box of numbers 2^k times as coarse, around it. *)
Definition coarse (k : Z) (b : box) : box :=
  Box (box_name b) (Z.shiftr (x0 b) k) (- Z.shiftr (- x1 b) k) (Z.shiftr (y0 b) k) (- Z.shiftr (- y1 b) k).

(* ---- far and near: squares of distances times sw^2, or heights ---- *)

Definition times (w z : Z) : Z := if w =? 1 then z else w * z.

Definition far (g : spot) (b : box) : Z :=
  let w := sw g in
  if 0 <? w then
    let u := reach (times w (x0 b)) (times w (x1 b)) (sx g) in
    let v := reach (times w (y0 b)) (times w (y1 b)) (sy g) in u * u + v * v
  else - bottom (sx g) (sy g) b.

Definition near (g : spot) (b : box) : Z :=
  let w := sw g in
  if 0 <? w then
    let u := gap (times w (x0 b)) (times w (x1 b)) (sx g) in
    let v := gap (times w (y0 b)) (times w (y1 b)) (sy g) in u * u + v * v
  else - top (sx g) (sy g) b.

(* ---- one triangle ---- *)

(* How far a site is from the three corners. *)
Record blocker : Type := Blocker { far_a : Z; far_b : Z; far_c : Z }.

Definition blocker_of (a b c : spot) (k : candidate) : blocker :=
  Blocker (far a (area k)) (far b (area k)) (far c (area k)).

(* The nearest one of a list, or k. *)
Definition nearest_of (g : spot) (l : list candidate) (k : candidate) : candidate :=
  fst (fold_left (fun best i => let f := far g (area i) in if f <? snd best then (i, f) else best) l (k, far g (area k))).

(* Is the site farther from each corner than one of the blockers is? *)
Definition is_blocked (a b c : spot) (q : list blocker) (i : candidate) : bool :=
  let na := near a (area i) in
  match kept (fun k => far_a k <? na) q with
  | [] => false
  | some =>
    let nb := near b (area i) in
    match kept (fun k => far_b k <? nb) some with
    | [] => false
    | some => let nc := near c (area i) in existsb (fun k => far_c k <? nc) some
    end
  end.

Definition remaining (a b c : spot) (l : list candidate) : list candidate :=
  match l with
  | [] => []
  | k :: _ =>
    let q := map (fun g => blocker_of a b c (nearest_of g l k)) [a; b; c] in
    kept (fun i => negb (is_blocked a b c q i)) l
  end.

(* Is each pair that is looked for listed? *)
Fixpoint all_listed (m : Map.t edge) (l : list candidate) : bool :=
  match l with
  | [] => true
  | i :: rest => forallb (fun j => is_legal m (box_name (area i)) (box_name (area j))) rest && all_listed m rest
  end.

(* The triangle with the side to be cut first. *)
Definition turned (h : cutting) (a b c : spot) : spot * spot * spot :=
  if side h =? 0 then (a, b, c) else if side h =? 1 then (b, c, a) else (c, a, b).

Definition cuts (h : cutting) (a b : spot) : bool :=
  let m := middle h in
  (0 <? weight h) && (0 <? other_weight h) && (0 <? divisor h) && (0 <=? sw m) &&
  (divisor h * sx m =? weight h * sx a + other_weight h * sx b) &&
  (divisor h * sy m =? weight h * sy a + other_weight h * sy b) &&
  (divisor h * sw m =? weight h * sw a + other_weight h * sw b).

(* ---- all ---- *)

Section Explored.
Variable hint : spot -> spot -> spot -> option cutting.
Variable m : Map.t edge.

(* What of the effort is left when no triangle holds a pair that is not listed. *)
Fixpoint explore (depth : nat) (effort : Z) (a b c : spot) (l : list candidate) : option Z :=
  let rest := remaining a b c l in
  if all_listed m (kept sought rest) then Some (effort - 1)
  else match depth with
  | O => None
  | S depth =>
    match hint a b c with
    | Some h =>
      let '(p, q, r) := turned h a b c in
      if (0 <? effort) && cuts h p q then
        match explore depth (effort - 1) p (middle h) r rest with
        | Some left => explore depth left (middle h) q r rest
        | None => None
        end
      else None
    | None => None
    end
  end.

(* The four quarters around a point. *)
Definition explore_all (effort : Z) (o : spot) (l : list candidate) : option Z :=
  let east := Spot 1 0 0 in let north := Spot 0 1 0 in let west := Spot (-1) 0 0 in let south := Spot 0 (-1) 0 in
  fold_left (fun left q => match left with Some left => explore deepest left o (fst q) (snd q) l | None => None end)
    [(east, north); (north, west); (west, south); (south, east)] (Some effort).
End Explored.

(* Are the pairs of sites that are not surrounded listed, or illegal? *)
Definition all_covered (hint : spot -> spot -> spot -> option cutting) (k effort : Z) (o : spot) (D E : Z)
    (sites : list site) (listed : list edge) (found : list fan) : bool :=
  match scaled_sites D E sites with
  | Some boxes =>
    let around := index centre found in
    let is_sought := fun b => match Map.find (box_name b) around with Some _ => false | None => true end in
    let l := fold_left (fun l b => Candidate (coarse k b) (is_sought b) :: l) boxes [] in
    (0 <=? k) && (0 <? sw o) &&
    match explore_all hint (map_edges listed) effort o l with Some _ => true | None => false end
  | None => false
  end.
