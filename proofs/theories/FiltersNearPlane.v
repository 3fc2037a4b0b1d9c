(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [WIT-NEAR] [WIT-HULL] The geometry of FiltersNear.v for points anywhere in the plane, and in the terms that the code
    computes: cross products, the in-circle determinant, squares of distances. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane Distance Cells Legal FiltersIncircle FiltersNear.
Open Scope R_scope.

(** ** Coordinates along an edge: its ends are (-h,0) and (h,0) *)

Section Frame.
Variables i j : point.
Variable h : R.
Variable Ph : 0 < h.
Variable Eh : 4 * (h * h) = dist2 i j.
Let ex := (fst j - fst i) / (2 * h).
Let ey := (snd j - snd i) / (2 * h).
Definition along (p : point) : R := (fst p - (fst i + fst j) / 2) * ex + (snd p - (snd i + snd j) / 2) * ey.
Definition beside (p : point) : R := (snd p - (snd i + snd j) / 2) * ex - (fst p - (fst i + fst j) / 2) * ey.

Lemma unit_vector : ex * ex + ey * ey = 1.
Proof.
  unfold ex, ey. apply Rmult_eq_reg_r with (4 * (h * h)); [|nra]. rewrite Eh at 2. unfold dist2. field. lra.
Qed.
Lemma edge_vector : fst j - fst i = 2 * h * ex /\ snd j - snd i = 2 * h * ey.
Proof. unfold ex, ey. split; field; lra. Qed.

Lemma dist2_frame p q : dist2 p q = (along p - along q) * (along p - along q) + (beside p - beside q) * (beside p -
  beside q).
Proof.
  replace (along p - along q) with ((fst p - fst q) * ex + (snd p - snd q) * ey) by (unfold along; ring).
  replace (beside p - beside q) with ((snd p - snd q) * ex - (fst p - fst q) * ey) by (unfold beside; ring).
  transitivity (dist2 p q * (ex * ex + ey * ey)); [rewrite unit_vector; ring|unfold dist2; ring].
Qed.

Lemma frame_i : along i = - h /\ beside i = 0.
Proof.
  destruct edge_vector as [X Y]. unfold along, beside.
  replace (fst i - (fst i + fst j) / 2) with (- (fst j - fst i) / 2) by field.
  replace (snd i - (snd i + snd j) / 2) with (- (snd j - snd i) / 2) by field. rewrite X, Y.
  split; [|field]. transitivity (- h * (ex * ex + ey * ey)); [field|rewrite unit_vector; ring].
Qed.
Lemma frame_j : along j = h /\ beside j = 0.
Proof.
  destruct edge_vector as [X Y]. unfold along, beside.
  replace (fst j - (fst i + fst j) / 2) with ((fst j - fst i) / 2) by field.
  replace (snd j - (snd i + snd j) / 2) with ((snd j - snd i) / 2) by field. rewrite X, Y.
  split; [|field]. transitivity (h * (ex * ex + ey * ey)); [field|rewrite unit_vector; ring].
Qed.

(** Cross products of vectors from i. *)
Lemma cross_frame p q :
  (fst p - fst i) * (snd q - snd i) - (snd p - snd i) * (fst q - fst i) =
  (along p + h) * beside q - beside p * (along q + h).
Proof.
  destruct frame_i as [A B].
  replace (along p + h) with ((fst p - fst i) * ex + (snd p - snd i) * ey) by (unfold along in *; lra).
  replace (along q + h) with ((fst q - fst i) * ex + (snd q - snd i) * ey) by (unfold along in *; lra).
  replace (beside q) with ((snd q - snd i) * ex - (fst q - fst i) * ey) by (unfold beside in *; lra).
  replace (beside p) with ((snd p - snd i) * ex - (fst p - fst i) * ey) by (unfold beside in *; lra).
  transitivity (((fst p - fst i) * (snd q - snd i) - (snd p - snd i) * (fst q - fst i)) * (ex * ex + ey * ey));
    [rewrite unit_vector; ring|ring].
Qed.

(** A centre on the bisector. *)
Lemma frame_centre c : dist2 c i = dist2 c j -> along c = 0 /\ dist2 c i = h * h + beside c * beside c.
Proof.
  rewrite !dist2_frame. destruct frame_i as [-> ->]. destruct frame_j as [-> ->]. intros H.
  assert (A : along c = 0) by (apply Rmult_eq_reg_l with (4 * h); lra). split; [exact A|]. rewrite A. ring.
Qed.
Lemma along_mix t p q : along (mix t p q) = (1 - t) * along p + t * along q.
Proof. unfold along, mix; simpl; ring. Qed.
Lemma beside_mix t p q : beside (mix t p q) = (1 - t) * beside p + t * beside q.
Proof. unfold beside, mix; simpl; ring. Qed.

(** The circle through i, j, u: twice the area is 2h times the height of u. *)
Lemma frame_circle c p : dist2 c i = dist2 c j -> dist2 c p = dist2 c i ->
  along p * along p + beside p * beside p - h * h = 2 * beside p * beside c /\
  dist2 p i * dist2 p j = 4 * (beside p * beside p) * (h * h + beside c * beside c).
Proof.
  intros C P. destruct (frame_centre c C) as [A D]. rewrite D, dist2_frame, A in P.
  assert (Q : along p * along p = 2 * beside p * beside c + h * h - beside p * beside p) by lra.
  split; [lra|]. rewrite (dist2_frame p i), (dist2_frame p j). destruct frame_i as [-> ->]. destruct frame_j as [-> ->].
  transitivity ((along p * along p + h * h + beside p * beside p) * (along p * along p + h * h + beside p * beside p)
    - 4 * (h * h) * (along p * along p)); [ring|rewrite Q; ring].
Qed.
End Frame.

(** ** The two conditions in the terms of the code *)

Definition cross_at (o p q : point) : R :=
  (fst p - fst o) * (snd q - snd o) - (snd p - snd o) * (fst q - fst o).
Definition det_at (o a b c : point) : R :=
  det3 (fst a - fst o) (snd a - snd o) (fst b - fst o) (snd b - snd o) (fst c - fst o) (snd c - snd o).

Lemma dist_of_squares x y r : 0 <= r -> dist2 x y = r * r -> dist x y = r.
Proof. intros P H. unfold dist. rewrite H. now apply sqrt_square. Qed.

(** E bounds the distance of sites from their representatives, m is a distance within which i and j have no neighbour. *)
Theorem edge_near_plane i j u v E m c1 c2 p :
  dist2 c1 i = dist2 c1 j -> dist2 c1 u = dist2 c1 i -> dist2 c2 i = dist2 c2 j -> dist2 c2 v = dist2 c2 i ->
  0 < cross_at i j u -> 0 < cross_at i v j -> 0 < det_at i j u v ->
  0 <= E -> 0 < m -> m <= dist i j -> 199 * E <= m ->
  2425 / 100 * E * (dist2 u i * dist2 u j) * cross_at i v j < m * det_at i j u v * cross_at i j u ->
  2425 / 100 * E * (dist2 v i * dist2 v j) * cross_at i j u < m * det_at i j u v * cross_at i v j ->
  dist c1 i <= dist c1 p -> dist c2 i <= dist c2 p -> m <= dist p i -> m <= dist p j ->
  dist (mix (1 / 2) c1 c2) i + 2 * E < dist (mix (1 / 2) c1 c2) p.
Proof.
  intros C1 U1 C2 V2 PA1 PA2 PD PE Pm Mij EM Cu Cv P1 P2 Mi Mj.
  pose (h := dist i j / 2).
  assert (Ph : 0 < h) by (unfold h; lra).
  assert (Eh : 4 * (h * h) = dist2 i j) by (rewrite <- dist_sq; unfold h; field).
  destruct (frame_i i j h Ph Eh) as [Ai Bi]. destruct (frame_j i j h Ph Eh) as [Aj Bj].
  destruct (frame_centre i j h Ph Eh c1 C1) as [A1 D1]. destruct (frame_centre i j h Ph Eh c2 C2) as [A2 D2].
  destruct (frame_circle i j h Ph Eh c1 u C1 U1) as [Ku Lu]. destruct (frame_circle i j h Ph Eh c2 v C2 V2) as [Kv Lv].
  set (su := along i j h u) in *. set (tu := beside i j h u) in *.
  set (sv := along i j h v) in *. set (tv := beside i j h v) in *.
  set (y1 := beside i j h c1) in *. set (y2 := beside i j h c2) in *.
  assert (X1 : cross_at i j u = 2 * h * tu).
  { unfold cross_at. rewrite (cross_frame i j h Ph Eh), Aj, Bj. fold su tu. ring. }
  assert (X2 : cross_at i v j = 2 * h * - tv).
  { unfold cross_at. rewrite (cross_frame i j h Ph Eh), Aj, Bj. fold sv tv. ring. }
  assert (XD : det_at i j u v = 4 * (h * (tu * - tv)) * (y1 - y2)).
  { unfold det_at, det3.
    replace ((fst u - fst i) * (snd v - snd i) - (snd u - snd i) * (fst v - fst i))
      with ((su + h) * tv - tu * (sv + h)) by (symmetry; apply (cross_frame i j h Ph Eh)).
    fold (cross_at i v j) (cross_at i j u). rewrite X1, X2.
    fold (dist2 j i) (dist2 u i) (dist2 v i). rewrite !(dist2_frame i j h Ph Eh), Ai, Bi, Aj, Bj. fold su tu sv tv.
    replace (su * su) with (2 * tu * y1 + h * h - tu * tu) by lra.
    transitivity (2 * h * (2 * h * ((su + h) * tv - tu * (sv + h)) - ((su + h) * (su + h) + tu * tu) * tv +
      ((sv + h) * (sv + h) + tv * tv) * tu)); [ring|].
    transitivity (2 * h * ((h * h - su * su - tu * tu) * tv - (h * h - sv * sv - tv * tv) * tu)); [ring|].
    replace (h * h - su * su - tu * tu) with (- (2 * tu * y1)) by lra.
    replace (h * h - sv * sv - tv * tv) with (- (2 * tv * y2)) by lra. ring. }
  assert (Ptu : 0 < tu) by (apply Rmult_lt_reg_l with (2 * h); lra).
  assert (Ptv : 0 < - tv) by (apply Rmult_lt_reg_l with (2 * h); lra).
  assert (Pt : 0 < tu * - tv) by now apply Rmult_lt_0_compat.
  assert (Pht : 0 < 4 * (h * (tu * - tv))) by (assert (0 < h * (tu * - tv)) by (now apply Rmult_lt_0_compat); lra).
  assert (D : 0 < y1 - y2) by (apply Rmult_lt_reg_l with (4 * (h * (tu * - tv))); lra).
  rewrite X1, X2, XD, Lu in Cu. rewrite X1, X2, XD, Lv in Cv.
  assert (Cu' : 2425 / 100 * E * (h * h + y1 * y1) < m * h * (y1 - y2)).
  { apply Rmult_lt_reg_l with (8 * (h * (tu * - tv)) * tu); [apply Rmult_lt_0_compat; lra|]. lra. }
  assert (Cv' : 2425 / 100 * E * (h * h + y2 * y2) < m * h * (y1 - y2)).
  { apply Rmult_lt_reg_l with (8 * (h * (tu * - tv)) * - tv); [apply Rmult_lt_0_compat; lra|]. lra. }
  set (c := mix (1 / 2) c1 c2).
  assert (Ac : along i j h c = 0) by (unfold c; rewrite along_mix, A1, A2; ring).
  assert (Bc : beside i j h c = (y1 + y2) / 2) by (unfold c; rewrite beside_mix; fold y1 y2; field).
  assert (Dci : dist2 c i = h * h + (y1 + y2) / 2 * ((y1 + y2) / 2)).
  { rewrite (dist2_frame i j h Ph Eh), Ac, Bc, Ai, Bi. ring. }
  pose (r2 := Rmax (h * h + y1 * y1) (h * h + y2 * y2)).
  assert (R2 : 0 <= r2) by (apply Rle_trans with (h * h + y1 * y1); [nra|apply Rmax_l]).
  apply dist_le in P1. apply dist_le in P2. rewrite D1 in P1. rewrite D2 in P2.
  rewrite (dist2_frame i j h Ph Eh), A1 in P1. rewrite (dist2_frame i j h Ph Eh), A2 in P2. fold y1 in P1. fold y2 in P2.
  assert (Si : m * m <= dist2 p i) by (rewrite <- dist_sq; apply Rmult_le_compat; lra).
  assert (Sj : m * m <= dist2 p j) by (rewrite <- dist_sq; apply Rmult_le_compat; lra).
  rewrite (dist2_frame i j h Ph Eh), Ai, Bi in Si. rewrite (dist2_frame i j h Ph Eh), Aj, Bj in Sj.
  set (s := along i j h p) in *. set (t := beside i j h p) in *.
  assert (G : (dist c i + 2 * E) * (dist c i + 2 * E) < s * s + (t - (y1 + y2) / 2) * (t - (y1 + y2) / 2)).
  { apply (edge_near_witness s t y1 y2 h (dist c i) (sqrt r2) E m); try lra.
    - apply dist_nonneg.
    - rewrite dist_sq. exact Dci.
    - apply sqrt_pos.
    - rewrite sqrt_sqrt by exact R2. apply Rmax_l.
    - rewrite sqrt_sqrt by exact R2. apply Rmax_r.
    - apply Rabs_pos_lt. lra.
    - unfold h; lra.
    - rewrite sqrt_sqrt, (Rabs_pos_eq (y1 - y2)) by lra. unfold r2, Rmax. destruct (Rle_dec _ _); assumption. }
  assert (Dcp : dist2 c p = s * s + (t - (y1 + y2) / 2) * (t - (y1 + y2) / 2)).
  { rewrite (dist2_frame i j h Ph Eh), Ac, Bc. fold s t. ring. }
  rewrite <- Dcp, <- dist_sq in G.
  destruct (Rlt_or_le (dist c i + 2 * E) (dist c p)) as [L|L]; [exact L|exfalso].
  assert (dist c p * dist c p <= (dist c i + 2 * E) * (dist c i + 2 * E)); [|lra].
  apply Rmult_le_compat; try exact L; apply dist_nonneg.
Qed.

(** The point at the distance r from c1, across the edge from i to j (outward when the inside is on the left). *)
Definition across (i j c1 : point) (r : R) : point :=
  (fst c1 + r * ((snd j - snd i) / dist i j), snd c1 - r * ((fst j - fst i) / dist i j)).

Theorem hull_edge_near_plane i j u E m c1 p :
  dist2 c1 i = dist2 c1 j -> dist2 c1 u = dist2 c1 i -> 0 < cross_at i j u ->
  0 <= E -> 0 < m -> m <= dist i j -> 199 * E <= m ->
  4850 / 100 * E * sqrt (dist2 u i * dist2 u j) < m * cross_at i j u ->
  0 <= cross_at i j p -> dist c1 i <= dist c1 p -> m <= dist p i -> m <= dist p j ->
  dist (across i j c1 (dist c1 i)) i + 2 * E < dist (across i j c1 (dist c1 i)) p.
Proof.
  intros C1 U1 PA1 PE Pm Mij EM Cu PT P1 Mi Mj.
  pose (h := dist i j / 2).
  assert (Ph : 0 < h) by (unfold h; lra).
  assert (Eh : 4 * (h * h) = dist2 i j) by (rewrite <- dist_sq; unfold h; field).
  destruct (frame_i i j h Ph Eh) as [Ai Bi]. destruct (frame_j i j h Ph Eh) as [Aj Bj].
  destruct (frame_centre i j h Ph Eh c1 C1) as [A1 D1].
  destruct (frame_circle i j h Ph Eh c1 u C1 U1) as [Ku Lu].
  set (su := along i j h u) in *. set (tu := beside i j h u) in *. set (y1 := beside i j h c1) in *.
  assert (X : forall q, cross_at i j q = 2 * h * beside i j h q).
  { intros q. unfold cross_at. rewrite (cross_frame i j h Ph Eh), Aj, Bj. ring. }
  rewrite X in PA1, Cu, PT. fold tu in PA1, Cu.
  assert (Ptu : 0 < tu) by (apply Rmult_lt_reg_l with (2 * h); lra).
  set (r1 := dist c1 i) in *. assert (R1 : r1 * r1 = h * h + y1 * y1) by (unfold r1; now rewrite dist_sq).
  assert (Pr1 : 0 < r1).
  { destruct (Rle_lt_or_eq_dec 0 r1 (dist_nonneg c1 i)) as [K|K]; [exact K|exfalso].
    assert (0 < h * h) by now apply Rmult_lt_0_compat. assert (0 <= y1 * y1) by apply Rle_0_sqr. rewrite <- K in R1. lra. }
  rewrite Lu, <- R1 in Cu.
  replace (4 * (tu * tu) * (r1 * r1)) with (2 * tu * r1 * (2 * tu * r1)) in Cu by ring.
  rewrite sqrt_square in Cu by (repeat apply Rmult_le_pos; lra).
  assert (Cu' : 4850 / 100 * E * r1 < m * h) by (apply Rmult_lt_reg_l with (2 * tu); lra).
  set (c := across i j c1 r1).
  assert (Ac : along i j h c = 0).
  { rewrite <- A1. unfold c, across, along. simpl. replace (dist i j) with (2 * h) by (unfold h; field). field. lra. }
  assert (Bc : beside i j h c = y1 - r1).
  { unfold y1. transitivity (beside i j h c1 - r1 * (((fst j - fst i) / (2 * h)) * ((fst j - fst i) / (2 * h)) +
      ((snd j - snd i) / (2 * h)) * ((snd j - snd i) / (2 * h)))).
    - unfold c, across, beside. simpl. replace (dist i j) with (2 * h) by (unfold h; field). field. lra.
    - rewrite (unit_vector i j h Ph Eh). ring. }
  assert (Dci : dist2 c i = h * h + (y1 - r1) * (y1 - r1)).
  { rewrite (dist2_frame i j h Ph Eh), Ac, Bc, Ai, Bi. ring. }
  apply dist_le in P1. rewrite D1, <- R1, (dist2_frame i j h Ph Eh), A1 in P1. fold y1 in P1.
  assert (Si : m * m <= dist2 p i) by (rewrite <- dist_sq; apply Rmult_le_compat; lra).
  assert (Sj : m * m <= dist2 p j) by (rewrite <- dist_sq; apply Rmult_le_compat; lra).
  rewrite (dist2_frame i j h Ph Eh), Ai, Bi in Si. rewrite (dist2_frame i j h Ph Eh), Aj, Bj in Sj.
  set (s := along i j h p) in *. set (t := beside i j h p) in *.
  assert (G : (dist c i + 2 * E) * (dist c i + 2 * E) < s * s + (t - (y1 - r1)) * (t - (y1 - r1))).
  { apply (hull_edge_near_witness s t y1 r1 h (dist c i) E m); try lra.
    - apply dist_nonneg.
    - rewrite dist_sq. exact Dci.
    - unfold h; lra.
    - apply Rmult_le_reg_l with (2 * h); lra. }
  assert (Dcp : dist2 c p = s * s + (t - (y1 - r1)) * (t - (y1 - r1))).
  { rewrite (dist2_frame i j h Ph Eh), Ac, Bc. fold s t. ring. }
  rewrite <- Dcp, <- dist_sq in G.
  destruct (Rlt_or_le (dist c i + 2 * E) (dist c p)) as [L|L]; [exact L|exfalso].
  assert (dist c p * dist c p <= (dist c i + 2 * E) * (dist c i + 2 * E)); [|lra].
  apply Rmult_le_compat; try exact L; apply dist_nonneg.
Qed.

(** ** Rectangles within E of their representatives *)

Definition within (N : nat) (B : sites) (p : nat -> point) (E : R) : Prop :=
  forall k z, (k < N)%nat -> inside z (B k) -> dist z (p k) <= E.

Lemma clear_is_witness N B p E i j c : within N B p E -> (i < N)%nat -> (j < N)%nat -> dist c (p j) = dist c (p i) ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> dist c (p i) + 2 * E < dist c (p k)) -> witness N B i j c.
Proof.
  intros W I J Eq H k K Di Dj. specialize (H k K Di Dj).
  pose proof (W k _ K (nearest_inside c (B k))) as Wk.
  pose proof (dist_triangle c (nearest c (B k)) (p k)) as Tk.
  pose proof (W i _ I (farthest_inside c (B i))) as Wi. pose proof (W j _ J (farthest_inside c (B j))) as Wj.
  pose proof (dist_triangle c (p i) (farthest c (B i))) as Ti. pose proof (dist_triangle c (p j) (farthest c (B j))) as Tj.
  rewrite (dist_sym (p i)) in Ti. rewrite (dist_sym (p j)) in Tj. rewrite Eq in Tj. unfold dl, ds. split; lra.
Qed.

Lemma on_bisector c1 c2 x y : dist2 c1 x = dist2 c1 y -> dist2 c2 x = dist2 c2 y ->
  dist2 (mix (1 / 2) c1 c2) x = dist2 (mix (1 / 2) c1 c2) y.
Proof. unfold dist2, mix. cbn [fst snd]. lra. Qed.
Lemma across_bisector i j c r : 0 < dist i j -> dist2 c j = dist2 c i -> dist2 (across i j c r) j = dist2 (across i j c r) i.
Proof. intros P H. unfold across, dist2 in *. cbn [fst snd]. unfold Rdiv. lra. Qed.

(** c is the centre of a circle through the representatives i, j, k, and no representative is inside it. *)
Definition empty_circle (N : nat) (p : nat -> point) (c : point) (i j k : nat) : Prop :=
  dist c (p i) = dist c (p j) /\ dist c (p k) = dist c (p i) /\
  forall q, (q < N)%nat -> dist c (p i) <= dist c (p q).
(** No other representative is within m of i or of j. *)
Definition alone (N : nat) (p : nat -> point) (m : R) (i j : nat) : Prop :=
  m <= dist (p i) (p j) /\ forall q, (q < N)%nat -> q <> i -> q <> j -> m <= dist (p q) (p i) /\ m <= dist (p q) (p j).

Theorem edge_near_legal N B p E m i j k l c1 c2 : within N B p E -> (i < N)%nat -> (j < N)%nat ->
  empty_circle N p c1 i j k -> empty_circle N p c2 i j l -> alone N p m i j ->
  0 < cross_at (p i) (p j) (p k) -> 0 < cross_at (p i) (p l) (p j) -> 0 < det_at (p i) (p j) (p k) (p l) ->
  0 <= E -> 0 < m -> 199 * E <= m ->
  2425 / 100 * E * (dist2 (p k) (p i) * dist2 (p k) (p j)) * cross_at (p i) (p l) (p j) <
    m * det_at (p i) (p j) (p k) (p l) * cross_at (p i) (p j) (p k) ->
  2425 / 100 * E * (dist2 (p l) (p i) * dist2 (p l) (p j)) * cross_at (p i) (p j) (p k) <
    m * det_at (p i) (p j) (p k) (p l) * cross_at (p i) (p l) (p j) ->
  witness N B i j (mix (1 / 2) c1 c2).
Proof.
  intros W I J (C1 & U1 & Q1) (C2 & V2 & Q2) [Mij M] A1 A2 D PE Pm EM Cu Cv.
  pose proof (proj1 (dist_eq _ _ _ _) C1) as C1'. pose proof (proj1 (dist_eq _ _ _ _) C2) as C2'.
  pose proof (proj1 (dist_eq _ _ _ _) U1) as U1'. pose proof (proj1 (dist_eq _ _ _ _) V2) as V2'.
  apply (clear_is_witness N B p E i j); try assumption.
  - apply dist_eq. apply (on_bisector c1 c2); now symmetry.
  - intros q Hq Qi Qj. destruct (M q Hq Qi Qj) as [Mi Mj].
    apply (edge_near_plane (p i) (p j) (p k) (p l) E m); try assumption; [now apply Q1|now apply Q2].
Qed.

Theorem hull_edge_near_legal N B p E m i j k c1 : within N B p E -> (i < N)%nat -> (j < N)%nat ->
  empty_circle N p c1 i j k -> alone N p m i j -> (forall q, (q < N)%nat -> 0 <= cross_at (p i) (p j) (p q)) ->
  0 < cross_at (p i) (p j) (p k) -> 0 <= E -> 0 < m -> 199 * E <= m ->
  4850 / 100 * E * sqrt (dist2 (p k) (p i) * dist2 (p k) (p j)) < m * cross_at (p i) (p j) (p k) ->
  witness N B i j (across (p i) (p j) c1 (dist c1 (p i))).
Proof.
  intros W I J (C1 & U1 & Q1) [Mij M] Side A1 PE Pm EM Cu.
  pose proof (proj1 (dist_eq _ _ _ _) C1) as C1'. pose proof (proj1 (dist_eq _ _ _ _) U1) as U1'.
  apply (clear_is_witness N B p E i j); try assumption.
  - apply dist_eq. apply across_bisector; [lra|now symmetry].
  - intros q Hq Qi Qj. destruct (M q Hq Qi Qj) as [Mi Mj].
    apply (hull_edge_near_plane (p i) (p j) (p k) E m); try assumption; [now apply Side|now apply Q1].
Qed.
