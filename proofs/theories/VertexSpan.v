(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The centre of the circle through three points known to rectangles, in intervals with exact ends [VTX-1]. *)
From Coq Require Import Reals Lra Lia Psatz.
From Dyadel Require Import Plane Distance Orientation.
Open Scope R_scope.

(* Intervals and their operations as in src/voronoi/vertex.c. *)
Record span : Type := Span { lo : R; hi : R }.
Definition holds (s : span) (x : R) : Prop := lo s <= x <= hi s.
Definition least4 (a b c d : R) : R := Rmin (Rmin (Rmin a b) c) d.
Definition most4 (a b c d : R) : R := Rmax (Rmax (Rmax a b) c) d.
Definition span_mul (s t : span) : span :=
  Span (least4 (lo s * lo t) (hi s * lo t) (lo s * hi t) (hi s * hi t))
       (most4 (lo s * lo t) (hi s * lo t) (lo s * hi t) (hi s * hi t)).
Definition span_sub (s t : span) : span := Span (lo s - hi t) (hi s - lo t).
Definition span_cross (a b c d : span) : span := span_sub (span_mul a b) (span_mul c d).
Definition least_square (s : span) : R :=
  if Rle_dec (lo s) 0 then if Rle_dec 0 (hi s) then 0 else Rmin (lo s * lo s) (hi s * hi s)
  else Rmin (lo s * lo s) (hi s * hi s).
Definition most_square (s : span) : R := Rmax (lo s * lo s) (hi s * hi s).
Definition span_norm (x y : span) : span := Span (least_square x + least_square y) (most_square x + most_square y).
Definition span_twice (s : span) : span := Span (2 * lo s) (2 * hi s).
Definition span_neg (s : span) : span := Span (- hi s) (- lo s).
Definition span_quotient (a n d : span) : span :=
  Span (lo a + lo n / (if Rle_dec 0 (lo n) then hi d else lo d)) (hi a + hi n / (if Rle_dec 0 (hi n) then lo d else hi d)).

Lemma least4_le a b c d : least4 a b c d <= a /\ least4 a b c d <= b /\ least4 a b c d <= c /\ least4 a b c d <= d.
Proof.
  unfold least4. pose proof (Rmin_l (Rmin (Rmin a b) c) d). pose proof (Rmin_r (Rmin (Rmin a b) c) d).
  pose proof (Rmin_l (Rmin a b) c). pose proof (Rmin_r (Rmin a b) c). pose proof (Rmin_l a b). pose proof (Rmin_r a b). lra.
Qed.
Lemma most4_ge a b c d : a <= most4 a b c d /\ b <= most4 a b c d /\ c <= most4 a b c d /\ d <= most4 a b c d.
Proof.
  unfold most4. pose proof (Rmax_l (Rmax (Rmax a b) c) d). pose proof (Rmax_r (Rmax (Rmax a b) c) d).
  pose proof (Rmax_l (Rmax a b) c). pose proof (Rmax_r (Rmax a b) c). pose proof (Rmax_l a b). pose proof (Rmax_r a b). lra.
Qed.

Lemma product_between a b c d x y l h : a <= x <= b -> c <= y <= d ->
  l <= a * c <= h -> l <= b * c <= h -> l <= a * d <= h -> l <= b * d <= h -> l <= x * y <= h.
Proof.
  intros X Y P1 P2 P3 P4.
  assert (C : l <= x * c <= h) by (destruct (Rle_lt_dec 0 c); nra).
  assert (D : l <= x * d <= h) by (destruct (Rle_lt_dec 0 d); nra).
  destruct (Rle_lt_dec 0 x); nra.
Qed.

Lemma mul_holds s t x y : holds s x -> holds t y -> holds (span_mul s t) (x * y).
Proof.
  intros X Y. unfold holds, span_mul in *. simpl.
  pose proof (least4_le (lo s * lo t) (hi s * lo t) (lo s * hi t) (hi s * hi t)).
  pose proof (most4_ge (lo s * lo t) (hi s * lo t) (lo s * hi t) (hi s * hi t)).
  apply (product_between (lo s) (hi s) (lo t) (hi t)); try assumption; lra.
Qed.
Lemma sub_holds s t x y : holds s x -> holds t y -> holds (span_sub s t) (x - y).
Proof. unfold holds, span_sub. simpl. lra. Qed.
Lemma cross_holds a b c d x y z w : holds a x -> holds b y -> holds c z -> holds d w ->
  holds (span_cross a b c d) (x * y - z * w).
Proof. intros. apply sub_holds; now apply mul_holds. Qed.
Lemma square_holds s x : holds s x -> least_square s <= x * x <= most_square s.
Proof.
  intros X. unfold holds, least_square, most_square in *. pose proof (Rmax_l (lo s * lo s) (hi s * hi s)).
  pose proof (Rmax_r (lo s * lo s) (hi s * hi s)). pose proof (Rmin_l (lo s * lo s) (hi s * hi s)).
  pose proof (Rmin_r (lo s * lo s) (hi s * hi s)).
  split; [destruct (Rle_dec (lo s) 0); [destruct (Rle_dec 0 (hi s)) |]; nra | destruct (Rle_lt_dec 0 x); nra].
Qed.
Lemma norm_holds s t x y : holds s x -> holds t y -> holds (span_norm s t) (x * x + y * y).
Proof. intros X Y. pose proof (square_holds s x X). pose proof (square_holds t y Y). unfold holds, span_norm. simpl. lra. Qed.
Lemma twice_holds s x : holds s x -> holds (span_twice s) (2 * x).
Proof. unfold holds, span_twice. simpl. lra. Qed.
Lemma neg_holds s x : holds s x -> holds (span_neg s) (- x).
Proof. unfold holds, span_neg. simpl. lra. Qed.
Lemma quotient_holds a n d x y z : 0 < lo d -> holds a x -> holds n y -> holds d z -> holds (span_quotient a n d) (x + y / z).
Proof.
  intros P X Y Z. unfold holds, span_quotient in *. simpl. assert (Hz : 0 < z) by lra.
  assert (G : forall u v, 0 < v -> u / v * v = u) by (intros; field; lra).
  split; apply Rplus_le_compat; try lra; apply (Rmult_le_reg_r z); try lra; rewrite (G y z Hz).
  - destruct (Rle_dec 0 (lo n)); [pose proof (G (lo n) (hi d) ltac:(lra)) | pose proof (G (lo n) (lo d) P)];
    [set (q := lo n / hi d) in * | set (q := lo n / lo d) in *]; clearbody q.
    + assert (0 <= q) by (apply Rnot_lt_le; intros L; nra). nra.
    + assert (q < 0) by (apply Rnot_le_lt; intros L; nra). nra.
  - destruct (Rle_dec 0 (hi n)); [pose proof (G (hi n) (lo d) P) | pose proof (G (hi n) (hi d) ltac:(lra))];
    [set (q := hi n / lo d) in * | set (q := hi n / hi d) in *]; clearbody q.
    + assert (0 <= q) by (apply Rnot_lt_le; intros L; nra). nra.
    + assert (q < 0) by (apply Rnot_le_lt; intros L; nra). nra.
Qed.

(* The enclosure for three rectangles; the code gives none unless `known`. *)
Definition side_x (A : rect) : span := Span (xlo A) (xhi A).
Definition side_y (A : rect) : span := Span (ylo A) (yhi A).
Section Rectangles.
Variables A B C : rect.
Let px := span_sub (side_x B) (side_x A). Let py := span_sub (side_y B) (side_y A).
Let qx := span_sub (side_x C) (side_x A). Let qy := span_sub (side_y C) (side_y A).
Definition below : span := span_twice (span_cross px qy py qx).
Definition above_x : span := span_cross qy (span_norm px py) py (span_norm qx qy).
Definition above_y : span := span_cross px (span_norm qx qy) qx (span_norm px py).
Definition known : Prop := 0 < lo below \/ hi below < 0.
Definition centre_x : span := if Rlt_dec (hi below) 0 then span_quotient (side_x A) (span_neg above_x) (span_neg below)
  else span_quotient (side_x A) above_x below.
Definition centre_y : span := if Rlt_dec (hi below) 0 then span_quotient (side_y A) (span_neg above_y) (span_neg below)
  else span_quotient (side_y A) above_y below.

(* It holds the only place at one distance from a, b, c, for every choice. *)
Theorem vertex_enclosed a b c z : known -> inside a A -> inside b B -> inside c C ->
  dist z a = dist z b -> dist z a = dist z c -> holds centre_x (fst z) /\ holds centre_y (snd z).
Proof.
  intros K [Ax Ay] [Bx By] [Cx Cy] E F. apply dist_eq in E. apply dist_eq in F.
  set (p1 := fst b - fst a). set (p2 := snd b - snd a). set (q1 := fst c - fst a). set (q2 := snd c - snd a).
  assert (P1 : holds px p1) by now apply sub_holds. assert (P2 : holds py p2) by now apply sub_holds.
  assert (Q1 : holds qx q1) by now apply sub_holds. assert (Q2 : holds qy q2) by now apply sub_holds.
  assert (D : holds below (2 * (p1 * q2 - p2 * q1))) by (apply twice_holds; now apply cross_holds).
  assert (Nx : holds above_x (q2 * (p1 * p1 + p2 * p2) - p2 * (q1 * q1 + q2 * q2)))
    by (apply cross_holds; try assumption; now apply norm_holds).
  assert (Ny : holds above_y (p1 * (q1 * q1 + q2 * q2) - q1 * (p1 * p1 + p2 * p2)))
    by (apply cross_holds; try assumption; now apply norm_holds).
  set (d := 2 * (p1 * q2 - p2 * q1)) in *. set (nx := q2 * _ - _) in *. set (ny := p1 * (q1 * q1 + q2 * q2) - _) in *.
  assert (Hp : 2 * ((fst z - fst a) * p1 + (snd z - snd a) * p2) = p1 * p1 + p2 * p2) by (unfold p1, p2; unfold dist2 in E; lra).
  assert (Hq : 2 * ((fst z - fst a) * q1 + (snd z - snd a) * q2) = q1 * q1 + q2 * q2) by (unfold q1, q2; unfold dist2 in F; lra).
  assert (Ex : (fst z - fst a) * d = nx) by (unfold d, nx; rewrite <- Hp, <- Hq; ring).
  assert (Ey : (snd z - snd a) * d = ny) by (unfold d, ny; rewrite <- Hp, <- Hq; ring).
  assert (Hd : d <> 0) by (unfold known, holds in *; intros Z; destruct K; lra).
  assert (Zx : fst z = fst a + nx / d) by (rewrite <- Ex; field; exact Hd).
  assert (Zy : snd z = snd a + ny / d) by (rewrite <- Ey; field; exact Hd).
  unfold centre_x, centre_y. destruct (Rlt_dec (hi below) 0) as [L | L].
  - replace (nx / d) with (- nx / - d) in Zx by (field; exact Hd). replace (ny / d) with (- ny / - d) in Zy by (field; exact Hd).
    assert (Pn : 0 < lo (span_neg below)) by (change (0 < - hi below); lra).
    rewrite Zx, Zy. split; apply quotient_holds; try exact Pn; try assumption; now apply neg_holds.
  - rewrite Zx, Zy. destruct K as [K | K]; [| contradiction]. split; apply quotient_holds; assumption.
Qed.
End Rectangles.

(* ---- narrower and narrower ---- *)

Definition tends (s : nat -> span) (x : R) : Prop := Un_cv (fun n => lo (s n)) x /\ Un_cv (fun n => hi (s n)) x.

(* Each member one of two that tend to one place. *)
Lemma picked_tends (u v w : nat -> R) l : Un_cv u l -> Un_cv v l -> (forall n, w n = u n \/ w n = v n) -> Un_cv w l.
Proof.
  intros U V H e E. destruct (U e E) as [n Hn]. destruct (V e E) as [m Hm]. exists (Nat.max n m). intros k K.
  destruct (H k) as [-> | ->]; [apply Hn | apply Hm]; lia.
Qed.
Lemma min_tends u v l : Un_cv u l -> Un_cv v l -> Un_cv (fun n => Rmin (u n) (v n)) l.
Proof. intros U V. apply (picked_tends u v); try assumption. intros n. unfold Rmin. destruct (Rle_dec (u n) (v n)); tauto. Qed.
Lemma max_tends u v l : Un_cv u l -> Un_cv v l -> Un_cv (fun n => Rmax (u n) (v n)) l.
Proof. intros U V. apply (picked_tends u v); try assumption. intros n. unfold Rmax. destruct (Rle_dec (u n) (v n)); tauto. Qed.

Lemma mul_tends s t x y : tends s x -> tends t y -> tends (fun n => span_mul (s n) (t n)) (x * y).
Proof.
  intros [S1 S2] [T1 T2]. pose proof (CV_mult _ _ _ _ S1 T1). pose proof (CV_mult _ _ _ _ S2 T1).
  pose proof (CV_mult _ _ _ _ S1 T2). pose proof (CV_mult _ _ _ _ S2 T2).
  split; simpl; unfold least4, most4; repeat (apply min_tends || apply max_tends); assumption.
Qed.
Lemma sub_tends s t x y : tends s x -> tends t y -> tends (fun n => span_sub (s n) (t n)) (x - y).
Proof. intros [S1 S2] [T1 T2]. split; simpl; now apply CV_minus. Qed.
Lemma cross_tends a b c d x y z w : tends a x -> tends b y -> tends c z -> tends d w ->
  tends (fun n => span_cross (a n) (b n) (c n) (d n)) (x * y - z * w).
Proof.
  intros. unfold span_cross. apply (sub_tends (fun n => span_mul (a n) (b n)) (fun n => span_mul (c n) (d n))); now apply mul_tends.
Qed.
Lemma twice_tends s x : tends s x -> tends (fun n => span_twice (s n)) (2 * x).
Proof.
  intros [S1 S2]. split; simpl; apply CV_mult; try assumption; intros e E; exists 0%nat; intros; unfold R_dist;
    rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; exact E.
Qed.
Lemma neg_tends s x : tends s x -> tends (fun n => span_neg (s n)) (- x).
Proof. intros [S1 S2]. split; simpl; now apply CV_opp. Qed.

Lemma square_tends s x : tends s x -> Un_cv (fun n => least_square (s n)) (x * x) /\ Un_cv (fun n => most_square (s n)) (x * x).
Proof.
  intros [S1 S2]. pose proof (CV_mult _ _ _ _ S1 S1) as L. pose proof (CV_mult _ _ _ _ S2 S2) as H.
  split; [| now apply max_tends].
  (* where 0 is between the ends, their product is not positive and tends to x^2: 0 is as near *)
  intros e E. destruct (min_tends _ _ _ L H e E) as [n Hn]. destruct (CV_mult _ _ _ _ S1 S2 e E) as [m Hm].
  exists (Nat.max n m). intros k K. specialize (Hn k ltac:(lia)). specialize (Hm k ltac:(lia)). unfold least_square.
  destruct (Rle_dec (lo (s k)) 0) as [A | A]; [| exact Hn]. destruct (Rle_dec 0 (hi (s k))) as [C | C]; [| exact Hn].
  assert (lo (s k) * hi (s k) <= 0) by nra. assert (0 <= x * x) by nra. unfold R_dist in *.
  rewrite Rabs_left1 by lra. rewrite Rabs_left1 in Hm by lra. lra.
Qed.
Lemma norm_tends s t x y : tends s x -> tends t y -> tends (fun n => span_norm (s n) (t n)) (x * x + y * y).
Proof.
  intros S T. destruct (square_tends s x S). destruct (square_tends t y T). split; simpl; now apply CV_plus.
Qed.

Lemma ratio_tends u v x y : Un_cv u x -> Un_cv v y -> y <> 0 -> Un_cv (fun n => u n / v n) (x / y).
Proof.
  intros U V Y. unfold Rdiv. apply CV_mult; [exact U |].
  apply (continuity_seq (fun z => / z) v y); [| exact V]. apply continuity_pt_inv; [| exact Y].
  apply derivable_continuous_pt, derivable_pt_id.
Qed.
Lemma quotient_tends a n d x y z : tends a x -> tends n y -> tends d z -> z <> 0 ->
  tends (fun k => span_quotient (a k) (n k) (d k)) (x + y / z).
Proof.
  intros [A1 A2] [N1 N2] [D1 D2] Z. split; simpl; apply CV_plus; try assumption.
  - apply (picked_tends (fun k => lo (n k) / hi (d k)) (fun k => lo (n k) / lo (d k))); try (now apply ratio_tends).
    intros k. destruct (Rle_dec 0 (lo (n k))); tauto.
  - apply (picked_tends (fun k => hi (n k) / lo (d k)) (fun k => hi (n k) / hi (d k))); try (now apply ratio_tends).
    intros k. destruct (Rle_dec 0 (hi (n k))); tauto.
Qed.

Definition shrinks (A : nat -> rect) (a : point) : Prop :=
  Un_cv (fun n => xlo (A n)) (fst a) /\ Un_cv (fun n => xhi (A n)) (fst a) /\
  Un_cv (fun n => ylo (A n)) (snd a) /\ Un_cv (fun n => yhi (A n)) (snd a).

Lemma either_tends (P : nat -> Prop) (D : forall n, {P n} + {~ P n}) s t x : tends s x -> tends t x ->
  tends (fun n => if D n then s n else t n) x.
Proof.
  intros [S1 S2] [T1 T2]. split.
  - apply (picked_tends (fun n => lo (s n)) (fun n => lo (t n))); try assumption. intros n. destruct (D n); tauto.
  - apply (picked_tends (fun n => hi (s n)) (fun n => hi (t n))); try assumption. intros n. destruct (D n); tauto.
Qed.

(* Rectangles that shrink to three points off a line: from some stage on there is an enclosure, and its ends tend to one place. *)
Theorem vertex_narrows A B C a b c : shrinks A a -> shrinks B b -> shrinks C c -> orient a b c <> 0 ->
  (exists m, forall n, (m <= n)%nat -> known (A n) (B n) (C n)) /\
  exists z, tends (fun n => centre_x (A n) (B n) (C n)) (fst z) /\ tends (fun n => centre_y (A n) (B n) (C n)) (snd z).
Proof.
  intros [A1 [A2 [A3 A4]]] [B1 [B2 [B3 B4]]] [C1 [C2 [C3 C4]]] O.
  assert (Ax : tends (fun n => side_x (A n)) (fst a)) by now split.
  assert (Ay : tends (fun n => side_y (A n)) (snd a)) by now split.
  assert (Px : tends (fun n => span_sub (side_x (B n)) (side_x (A n))) (fst b - fst a)) by (split; simpl; now apply CV_minus).
  assert (Py : tends (fun n => span_sub (side_y (B n)) (side_y (A n))) (snd b - snd a)) by (split; simpl; now apply CV_minus).
  assert (Qx : tends (fun n => span_sub (side_x (C n)) (side_x (A n))) (fst c - fst a)) by (split; simpl; now apply CV_minus).
  assert (Qy : tends (fun n => span_sub (side_y (C n)) (side_y (A n))) (snd c - snd a)) by (split; simpl; now apply CV_minus).
  pose proof (norm_tends _ _ _ _ Px Py) as Np. pose proof (norm_tends _ _ _ _ Qx Qy) as Nq.
  pose proof (twice_tends _ _ (cross_tends _ _ _ _ _ _ _ _ Px Qy Py Qx)) as D.
  pose proof (cross_tends _ _ _ _ _ _ _ _ Qy Np Py Nq) as X. pose proof (cross_tends _ _ _ _ _ _ _ _ Px Nq Qx Np) as Y.
  set (d := 2 * _) in D. set (nx := _ - _) in X. set (ny := _ - _) in Y.
  assert (Hd : d <> 0) by (unfold d, orient in *; intros E; apply O; lra). clearbody d nx ny.
  change (tends (fun n => below (A n) (B n) (C n)) d) in D. change (tends (fun n => above_x (A n) (B n) (C n)) nx) in X.
  change (tends (fun n => above_y (A n) (B n) (C n)) ny) in Y.
  split.
  - destruct D as [D1 D2]. destruct (D1 (Rabs d) (Rabs_pos_lt d Hd)) as [m1 M1]. destruct (D2 (Rabs d) (Rabs_pos_lt d Hd)) as [m2 M2].
    exists (Nat.max m1 m2). intros n L. specialize (M1 n ltac:(lia)). specialize (M2 n ltac:(lia)). unfold known, R_dist in *.
    apply Rabs_def2 in M1. apply Rabs_def2 in M2. destruct (Rlt_dec 0 d).
    + left. rewrite Rabs_pos_eq in * by lra. lra.
    + right. rewrite Rabs_left in * by lra. lra.
  - exists (fst a + nx / d, snd a + ny / d). split; simpl.
    + apply either_tends; [| now apply quotient_tends]. replace (nx / d) with (- nx / - d) by (field; exact Hd).
      apply quotient_tends; try (now apply neg_tends); try assumption; lra.
    + apply either_tends; [| now apply quotient_tends]. replace (ny / d) with (- ny / - d) by (field; exact Hd).
      apply quotient_tends; try (now apply neg_tends); try assumption; lra.
Qed.

(* Three points give a point. *)
Definition single (s : span) : Prop := lo s = hi s.
Lemma mul_single s t : single s -> single t -> single (span_mul s t).
Proof.
  unfold single, span_mul, least4, most4. intros -> ->. simpl. unfold Rmin, Rmax.
  repeat match goal with |- context [Rle_dec ?x ?y] => destruct (Rle_dec x y) end; lra.
Qed.
Lemma sub_single s t : single s -> single t -> single (span_sub s t).
Proof. unfold single, span_sub. simpl. lra. Qed.
Lemma norm_single s t : single s -> single t -> single (span_norm s t).
Proof.
  assert (G : forall s, single s -> least_square s = most_square s).
  { unfold single, least_square, most_square. intros r E. rewrite E. rewrite Rmin_left, Rmax_left by lra.
    destruct (Rle_dec (hi r) 0); [destruct (Rle_dec 0 (hi r)) |]; try reflexivity. assert (hi r = 0) as -> by lra. lra. }
  intros S T. unfold single, span_norm. simpl. now rewrite (G s S), (G t T).
Qed.
Lemma quotient_single a n d : single a -> single n -> single d -> single (span_quotient a n d).
Proof. unfold single, span_quotient. simpl. intros -> -> ->. destruct (Rle_dec 0 (hi n)); reflexivity. Qed.

Theorem vertex_exact A B C : xlo A = xhi A -> ylo A = yhi A -> xlo B = xhi B -> ylo B = yhi B -> xlo C = xhi C ->
  ylo C = yhi C -> single (centre_x A B C) /\ single (centre_y A B C).
Proof.
  intros A1 A2 B1 B2 C1 C2.
  assert (N : forall s, single s -> single (span_neg s)) by (unfold single, span_neg; simpl; intros; lra).
  assert (D : single (below A B C)).
  { unfold below. assert (G : forall s, single s -> single (span_twice s)) by (unfold single, span_twice; simpl; intros; lra).
    apply G. apply sub_single; apply mul_single; now apply sub_single. }
  assert (X : single (above_x A B C)) by (apply sub_single; apply mul_single; try (now apply sub_single);
    apply norm_single; now apply sub_single).
  assert (Y : single (above_y A B C)) by (apply sub_single; apply mul_single; try (now apply sub_single);
    apply norm_single; now apply sub_single).
  unfold centre_x, centre_y. destruct (Rlt_dec (hi (below A B C)) 0); split; apply quotient_single; auto.
Qed.
