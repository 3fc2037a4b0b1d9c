(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The two ends of the curve of centres [COV-1]: far out it is a ray, in one of the two directions in which both
   rectangles are equally high; a site beyond that height blocks all near the end. *)
From Coq Require Import Reals Lra Lia Psatz List Classical.
From Dyadel Require Import Plane Distance Cells Orientation Disc Curve CriticalExists Nerve Facing CurveWalk.
Open Scope R_scope.

(* Where the ray from o in direction w is after s. *)
Definition along (o w : point) (s : R) : point := (fst o + s * fst w, snd o + s * snd w).

Lemma ray_reaches b o w : 0 < w -> exists S, forall s, S <= s -> b <= o + s * w.
Proof.
  intros W. exists ((b - o) / w). intros s L. apply (Rmult_le_compat_r w) in L; [| lra].
  unfold Rdiv in L. rewrite Rmult_assoc, Rinv_l in L; lra.
Qed.

(* From some place on, a site beyond the height of q in direction w is nearer than q. *)
Lemma beyond_is_nearer o w q K : dot w q < dot w (lowest w K) ->
  exists S, forall s, S <= s -> dl (along o w s) K < dist (along o w s) q.
Proof.
  intros H. set (d := dot w (lowest w K) - dot w q). assert (D : 0 < d) by (unfold d; lra).
  set (m := dl o K * dl o K - dist2 o q). destruct (ray_reaches (Rabs m + 1) 0 d D) as [S HS].
  exists (Rmax S 0). intros s L.
  assert (S0 : 0 <= s) by (pose proof (Rmax_r S 0); lra).
  assert (M : Rabs m + 1 <= 0 + s * d) by (apply HS; pose proof (Rmax_l S 0); lra).
  unfold dl. apply dist_lt. set (z := farthest (along o w s) K).
  assert (Z : inside z K) by (unfold z; apply farthest_inside).
  destruct (lowest_spec w K) as [_ Low]. specialize (Low z Z).
  pose proof (le_dl o K z Z) as Far. apply (Rmult_le_compat _ _ _ _ (dist_nonneg o z) (dist_nonneg o z) Far) in Far.
  rewrite dist_sq in Far.
  assert (E : dist2 (along o w s) q - dist2 (along o w s) z = dist2 o q - dist2 o z + 2 * (s * (dot w z - dot w q)))
    by (unfold along, dist2, dot; simpl; ring).
  assert (s * d <= s * (dot w z - dot w q)) by (apply Rmult_le_compat_l; unfold d; lra).
  pose proof (Rle_abs m). assert (m = dl o K * dl o K - dist2 o q) by reflexivity. pose proof (Rabs_pos m). lra.
Qed.

(* Far out, one corner of a rectangle is nearest. *)
Definition ends_at (lo hi o w q : R) : Prop :=
  (0 < w /\ q = hi) \/ (w < 0 /\ q = lo) \/ (w = 0 /\ (lo <= o /\ q = hi /\ hi <= o \/ o <= lo /\ q = lo)).

Lemma coordinate_ends lo hi o w q : lo <= hi -> ends_at lo hi o w q ->
  exists S, forall s, S <= s -> clamp lo hi (o + s * w) = q.
Proof.
  intros L [[W ->] | [[W ->] | [-> H]]].
  - destruct (ray_reaches hi o w W) as [S H]. exists S. intros s Hs. specialize (H s Hs).
    unfold clamp. rewrite Rmin_left by lra. now apply Rmax_right.
  - destruct (ray_reaches (- lo) (- o) (- w)) as [S H]; [lra |]. exists S. intros s Hs. specialize (H s Hs).
    unfold clamp. rewrite Rmin_right by lra. apply Rmax_left. lra.
  - exists 0. intros s _. rewrite Rmult_0_r, Rplus_0_r. unfold clamp. destruct H as [(A & -> & C) | [A ->]].
    + rewrite Rmin_left by lra. now apply Rmax_right.
    + rewrite Rmin_right by lra. now apply Rmax_left.
Qed.

Lemma corner_ends B o w q : ends_at (xlo B) (xhi B) (fst o) (fst w) (fst q) ->
  ends_at (ylo B) (yhi B) (snd o) (snd w) (snd q) -> exists S, forall s, S <= s -> nearest (along o w s) B = q.
Proof.
  intros X Y. destruct (coordinate_ends _ _ _ _ _ (x_ordered B) X) as [S HS].
  destruct (coordinate_ends _ _ _ _ _ (y_ordered B) Y) as [T HT]. exists (Rmax S T). intros s L.
  pose proof (Rmax_l S T). pose proof (Rmax_r S T). unfold nearest, along. simpl. rewrite HS, HT by lra.
  symmetry. apply surjective_pairing.
Qed.

Section Ends.
(* Z on the right of Y; at height t, g t is equally far from both. *)
Variables (Y Z : rect).
Variable apart : xhi Y < xlo Z.
Variable g : R -> R.
Variable curve_of : forall x t, ds (x, t) Y = ds (x, t) Z <-> x = g t.

(* The outer normals of the two common tangents. *)
Definition end_up : point :=
  (yhi Y - yhi Z, if Rlt_dec (yhi Z) (yhi Y) then xhi Z - xhi Y else xlo Z - xlo Y).
Definition end_down : point :=
  (ylo Z - ylo Y, - (if Rlt_dec (ylo Y) (ylo Z) then xhi Z - xhi Y else xlo Z - xlo Y)).

Lemma ends_point : 0 < snd end_up /\ snd end_down < 0.
Proof.
  pose proof (x_ordered Y). pose proof (x_ordered Z). unfold end_up, end_down. simpl.
  split; destruct (Rlt_dec _ _); lra.
Qed.

(* From some place on, the ray through o in direction w is the curve, and q, as high as R_i, is nearest. *)
Definition is_end (w : point) : Prop := exists o q S, dot w q = dot w (highest w Y) /\
  dot w (highest w Y) = dot w (highest w Z) /\
  forall s, S <= s -> ds (along o w s) Y = dist (along o w s) q /\ ds (along o w s) Y = ds (along o w s) Z.

Lemma ends_by_corners w q q' : let o := mix (1 / 2) q q' in
  dot w q = dot w (highest w Y) -> dot w q' = dot w (highest w Z) -> dot w q = dot w q' ->
  ends_at (xlo Y) (xhi Y) (fst o) (fst w) (fst q) -> ends_at (ylo Y) (yhi Y) (snd o) (snd w) (snd q) ->
  ends_at (xlo Z) (xhi Z) (fst o) (fst w) (fst q') -> ends_at (ylo Z) (yhi Z) (snd o) (snd w) (snd q') -> is_end w.
Proof.
  intros o Hy Hz E A B C D. destruct (corner_ends Y o w q A B) as [S HS]. destruct (corner_ends Z o w q' C D) as [T HT].
  exists o, q, (Rmax S T). split; [exact Hy |]. split; [lra |]. intros s L.
  pose proof (Rmax_l S T). pose proof (Rmax_r S T). unfold ds. rewrite HS, HT by lra. split; [reflexivity |].
  apply dist_eq.
  assert (F : dist2 (along o w s) q - dist2 (along o w s) q' = 2 * (s * (dot w q' - dot w q)))
    by (unfold o, along, dist2, dot, mix; simpl; field).
  rewrite E in F. lra.
Qed.

(* By corners, both of them highest in direction w; `first`: what makes them so. *)
Ltac at_corners p q first :=
  apply (ends_by_corners _ p q); unfold ends_at, dot, highest; simpl; first; repeat destruct (Rle_dec 0 _); try lra.

Lemma up_is_end : is_end end_up.
Proof.
  pose proof (x_ordered Y). pose proof (x_ordered Z). unfold end_up. destruct (Rlt_dec (yhi Z) (yhi Y)) as [L | L].
  - at_corners (xhi Y, yhi Y) (xhi Z, yhi Z) idtac.
  - destruct (Req_dec (yhi Y) (yhi Z)) as [E | E].
    + at_corners (xhi Y, yhi Y) (xlo Z, yhi Z) ltac:(rewrite ?E).
    + at_corners (xlo Y, yhi Y) (xlo Z, yhi Z) idtac.
Qed.

Lemma down_is_end : is_end end_down.
Proof.
  pose proof (x_ordered Y). pose proof (x_ordered Z). unfold end_down. destruct (Rlt_dec (ylo Y) (ylo Z)) as [L | L].
  - at_corners (xhi Y, ylo Y) (xhi Z, ylo Z) idtac.
  - destruct (Req_dec (ylo Y) (ylo Z)) as [E | E].
    + at_corners (xhi Y, ylo Y) (xlo Z, ylo Z) ltac:(rewrite ?E).
    + at_corners (xlo Y, ylo Y) (xlo Z, ylo Z) idtac.
Qed.

(* Beyond the height of both in direction w. *)
Definition blocks_end (w : point) (K : rect) : Prop := dot w (highest w Y) < dot w (lowest w K).

Lemma blocks_far w K : is_end w -> blocks_end w K ->
  exists o S, forall s, S <= s -> dl (along o w s) K < ds (along o w s) Y /\ fst (along o w s) = g (snd (along o w s)).
Proof.
  intros (o & q & S & Top & _ & H) Bl. unfold blocks_end in Bl. rewrite <- Top in Bl.
  destruct (beyond_is_nearer o w q K Bl) as [T HT]. exists o, (Rmax S T). intros s L.
  pose proof (Rmax_l S T). pose proof (Rmax_r S T). destruct (H s) as [E F]; [lra |]. rewrite E.
  split; [apply HT; lra |].
  apply curve_of. now rewrite <- surjective_pairing.
Qed.

(* Who blocks the upper end blocks all near it, ... *)
Theorem blocks_near_up K : blocks_end end_up K -> exists T, forall t, T <= t -> 0 < ds (g t, t) Y - dl (g t, t) K.
Proof.
  intros Bl. destruct (blocks_far end_up K up_is_end Bl) as (o & S & H). destruct ends_point as [W _].
  exists (snd o + S * snd end_up). intros t L. set (s := (t - snd o) / snd end_up).
  assert (E : snd o + s * snd end_up = t) by (unfold s; field; lra).
  assert (Ls : S <= s) by (apply (Rmult_le_reg_r (snd end_up)); lra).
  destruct (H s Ls) as [N G]. change (snd (along o end_up s)) with (snd o + s * snd end_up) in G. rewrite E in G.
  assert (Q : along o end_up s = (g t, t)).
  { rewrite (surjective_pairing (along o end_up s)), G. f_equal. exact E. }
  rewrite Q in N. lra.
Qed.

(* ... and who blocks the lower end. *)
Theorem blocks_near_down K : blocks_end end_down K -> exists T, forall t, t <= T -> 0 < ds (g t, t) Y - dl (g t, t) K.
Proof.
  intros Bl. destruct (blocks_far end_down K down_is_end Bl) as (o & S & H). destruct ends_point as [_ W].
  exists (snd o + S * snd end_down). intros t L. set (s := (t - snd o) / snd end_down).
  assert (E : snd o + s * snd end_down = t) by (unfold s; field; lra).
  assert (Ls : S <= s) by (apply (Rmult_le_reg_r (- snd end_down)); lra).
  destruct (H s Ls) as [N G]. change (snd (along o end_down s)) with (snd o + s * snd end_down) in G. rewrite E in G.
  assert (Q : along o end_down s = (g t, t)).
  { rewrite (surjective_pairing (along o end_down s)), G. f_equal. exact E. }
  rewrite Q in N. lra.
Qed.

(* The two are all directions in which both are equally high. *)
Definition scaled (l : R) (w : point) : point := (l * fst w, l * snd w).

Lemma is_scaled w e : snd w * snd e > 0 -> fst w * snd e = snd w * fst e -> exists l, 0 < l /\ w = scaled l e.
Proof.
  intros P E. assert (snd e <> 0) by (intros F; rewrite F in P; lra). exists (snd w / snd e). split.
  - replace (snd w / snd e) with (snd w * snd e / (snd e * snd e)) by (field; assumption).
    apply Rdiv_lt_0_compat; [exact P |]. nra.
  - unfold scaled. rewrite (surjective_pairing w) at 1. f_equal; [| field; assumption].
    replace (snd w / snd e * fst e) with (snd w * fst e / snd e) by (field; assumption). rewrite <- E. field.
    assumption.
Qed.

Theorem only_two_ends w : w <> (0, 0) -> dot w (highest w Y) = dot w (highest w Z) ->
  exists l, 0 < l /\ (w = scaled l end_up \/ w = scaled l end_down).
Proof.
  intros W E. pose proof (x_ordered Y). pose proof (x_ordered Z). destruct w as [a b].
  assert (Up : 0 < b -> exists l, 0 < l /\ (a, b) = scaled l end_up).
  { intros P. apply is_scaled; simpl.
    - apply Rmult_gt_0_compat; [exact P | destruct ends_point; simpl in *; lra].
    - unfold dot, highest in E. simpl in E. destruct (Rle_dec 0 b); [| lra]. destruct (Rle_dec 0 a) as [A | A];
        destruct (Rlt_dec (yhi Z) (yhi Y)) as [L | L]; [lra | | | lra].
      + assert (0 <= a * (xhi Z - xhi Y)) by (apply Rmult_le_pos; lra).
        assert (0 <= b * (yhi Z - yhi Y)) by (apply Rmult_le_pos; lra).
        assert (X : a * (xhi Z - xhi Y) = 0) by lra. apply Rmult_integral in X. destruct X as [-> | X]; lra.
      + assert (0 < - a * (xlo Z - xlo Y)) by (apply Rmult_lt_0_compat; lra).
        assert (0 < b * (yhi Y - yhi Z)) by (apply Rmult_lt_0_compat; lra). lra. }
  assert (Down : b < 0 -> exists l, 0 < l /\ (a, b) = scaled l end_down).
  { intros P. apply is_scaled; simpl.
    - assert (0 < - b * - snd end_down) by (apply Rmult_lt_0_compat; destruct ends_point; lra). simpl in *. lra.
    - unfold dot, highest in E. simpl in E. destruct (Rle_dec 0 b); [lra |]. destruct (Rle_dec 0 a) as [A | A];
        destruct (Rlt_dec (ylo Y) (ylo Z)) as [L | L]; [lra | | | lra].
      + assert (0 <= a * (xhi Z - xhi Y)) by (apply Rmult_le_pos; lra).
        assert (0 <= - b * (ylo Y - ylo Z)) by (apply Rmult_le_pos; lra).
        assert (X : a * (xhi Z - xhi Y) = 0) by lra. apply Rmult_integral in X. destruct X as [-> | X]; lra.
      + assert (0 < - a * (xlo Z - xlo Y)) by (apply Rmult_lt_0_compat; lra).
        assert (0 < - b * (ylo Z - ylo Y)) by (apply Rmult_lt_0_compat; lra). lra. }
  destruct (Rtotal_order b 0) as [P | [-> | P]].
  - destruct (Down P) as (l & L & Q). exists l. split; [exact L | now right].
  - exfalso. unfold dot, highest in E. simpl in E. destruct (Rle_dec 0 a) as [A | A].
    + assert (X : a * (xhi Z - xhi Y) = 0) by lra. apply Rmult_integral in X.
      destruct X as [-> | X]; [now apply W | lra].
    + assert (0 < - a * (xlo Z - xlo Y)) by (apply Rmult_lt_0_compat; lra). lra.
  - destruct (Up P) as (l & L & Q). exists l. split; [exact L | now left].
Qed.

Lemma scaled_highest l w B : 0 < l -> dot (scaled l w) (highest (scaled l w) B) = l * dot w (highest w B).
Proof.
  intros L. assert (E : forall z, dot (scaled l w) z = l * dot w z) by (intros z; unfold dot, scaled; simpl; ring).
  destruct (highest_spec w B) as [I H]. destruct (highest_spec (scaled l w) B) as [J K]. apply Rle_antisym.
  - rewrite E. apply Rmult_le_compat_l; [lra | now apply H].
  - rewrite <- E. now apply K.
Qed.

Lemma scaled_lowest l w B : 0 < l -> dot (scaled l w) (lowest (scaled l w) B) = l * dot w (lowest w B).
Proof.
  intros L. assert (E : forall z, dot (scaled l w) z = l * dot w z) by (intros z; unfold dot, scaled; simpl; ring).
  destruct (lowest_spec w B) as [I H]. destruct (lowest_spec (scaled l w) B) as [J K]. apply Rle_antisym.
  - rewrite <- E. now apply K.
  - rewrite E. apply Rmult_le_compat_l; [lra | now apply H].
Qed.
End Ends.

(* There is such a curve, and it is continuous. *)
Theorem centres_curve Y Z : xhi Y < xlo Z ->
  exists g, continuity g /\ forall x t, ds (x, t) Y = ds (x, t) Z <-> x = g t.
Proof.
  intros L. assert (P : 0 < xlo Z - xhi Y) by lra.
  assert (S : forall a b, inside a Y -> inside b Z -> dot (1, 0) a + (xlo Z - xhi Y) <= dot (1, 0) b).
  { intros a b [[_ A] _] [[B _] _]. unfold dot. simpl. lra. }
  exists (curve (1, 0) (0, 1) 1 frame_right C Y Z _ P S). split; [apply curve_continuous |].
  assert (At : forall x t, at_ (1, 0) (0, 1) x t = (x, t)) by (intros; unfold at_; simpl; f_equal; ring).
  intros x t. split.
  - intros E. apply curve_unique. unfold excess. rewrite At. simpl. rewrite E. ring.
  - intros ->. pose proof (curve_equal (1, 0) (0, 1) 1 frame_right C Y Z _ P S t) as E. rewrite At in E. exact E.
Qed.

(* A direction shows the pair possible iff an end is blocked by no site. *)
Theorem ends_exact N B i j : (i < N)%nat -> (j < N)%nat -> xhi (B i) < xlo (B j) ->
  (exists u, possible_far N B (pair i j) u /\ dot u (highest u (B i)) = dot u (highest u (B j))) <->
  (forall k, (k < N)%nat -> ~ blocks_end (B i) (end_down (B i) (B j)) (B k)) \/
  (forall k, (k < N)%nat -> ~ blocks_end (B i) (end_up (B i) (B j)) (B k)).
Proof.
  intros I J Ap. unfold blocks_end. split.
  - intros [u [[U H] E]]. destruct (only_two_ends (B i) (B j) Ap u U E) as (l & L & [-> | ->]); [right | left];
      intros k K Bl; specialize (H i k I (or_introl eq_refl) K); rewrite scaled_highest, scaled_lowest in H by exact L;
      apply Rmult_le_reg_l in H; lra.
  - assert (Far : forall e, snd e <> 0 -> is_end (B i) (B j) e ->
      (forall k, (k < N)%nat -> ~ dot e (highest e (B i)) < dot e (lowest e (B k))) ->
      exists u, possible_far N B (pair i j) u /\ dot u (highest u (B i)) = dot u (highest u (B j))).
    { intros e D (_ & _ & _ & _ & E & _) H. exists e. split; [| exact E]. split; [intros ->; now apply D |].
      intros a k _ A K. apply Rnot_lt_le. intros L. apply (H k K). destruct A as [-> | ->]; lra. }
    destruct (ends_point (B i) (B j) Ap) as [U D]. intros [H | H].
    + apply (Far (end_down (B i) (B j))); [lra | now apply down_is_end | exact H].
    + apply (Far (end_up (B i) (B j))); [lra | now apply up_is_end | exact H].
Qed.

(* The walk along the curve says whether a pair is possible. *)
Theorem walk_says N B i j (g : R -> R) (circles : nat -> list R) :
  (i < N)%nat -> (j < N)%nat -> xhi (B i) < xlo (B j) ->
  continuity g -> (forall x t, ds (x, t) (B i) = ds (x, t) (B j) <-> x = g t) ->
  (forall k t, (k < N)%nat -> stops (fun s => ds (g s, s) (B i) - dl (g s, s) (B k)) t -> In t (circles k)) ->
  let free w := forall k, (k < N)%nat -> ~ blocks_end (B i) w (B k) in
  (possible N B i j <-> free (end_down (B i) (B j)) \/ free (end_up (B i) (B j)) \/
    walks N (fun k t => ds (g t, t) (B i) - dl (g t, t) (B k)) circles
      (fun k => blocks_end (B i) (end_down (B i) (B j)) (B k)) Start true).
Proof.
  intros I J Ap Cg Curve Listed free. unfold free.
  apply (walk_possible N B i j (fun t => (g t, t)) circles
    (fun k => blocks_end (B i) (end_down (B i) (B j)) (B k)) (fun k => blocks_end (B i) (end_up (B i) (B j)) (B k)));
    auto; simpl.
  - apply id_continuous.
  - intros [x y]. rewrite Curve. split; [intros ->; now exists y | intros [t E]]. now injection E as -> ->.
  - intros k K Bl. now apply (blocks_near_down (B i) (B j) Ap g Curve).
  - now apply ends_exact.
Qed.

(* Disjoint rectangles are apart along one of the axes, ... *)
Theorem disjoint_apart Y Z : (forall z, inside z Y -> ~ inside z Z) ->
  xhi Y < xlo Z \/ xhi Z < xlo Y \/ yhi Y < ylo Z \/ yhi Z < ylo Y.
Proof.
  intros D. destruct (Rlt_dec (xhi Y) (xlo Z)); [tauto |]. destruct (Rlt_dec (xhi Z) (xlo Y)); [tauto |].
  destruct (Rlt_dec (yhi Y) (ylo Z)); [tauto |]. destruct (Rlt_dec (yhi Z) (ylo Y)); [tauto |]. exfalso.
  pose proof (x_ordered Y). pose proof (x_ordered Z). pose proof (y_ordered Y). pose proof (y_ordered Z).
  apply (D (Rmax (xlo Y) (xlo Z), Rmax (ylo Y) (ylo Z))); unfold inside, Rmax; simpl;
    destruct (Rle_dec (xlo Y) (xlo Z)); destruct (Rle_dec (ylo Y) (ylo Z)); lra.
Qed.

(* ... and neither their order nor that of the axes matters. *)
Definition turned (z : point) : point := (snd z, fst z).

Lemma flipped_distances c B : ds (turned c) (flip B) = ds c B /\ dl (turned c) (flip B) = dl c B.
Proof. split; unfold ds, dl, dist, dist2, turned; simpl; f_equal; ring. Qed.

Lemma flipped_heights u B : dot (turned u) (highest (turned u) (flip B)) = dot u (highest u B) /\
  dot (turned u) (lowest (turned u) (flip B)) = dot u (lowest u B).
Proof. split; unfold dot, turned; simpl; ring. Qed.

Theorem possible_turned N B i j : possible N B i j <-> possible N (fun k => flip (B k)) i j.
Proof.
  assert (T : forall c, turned (turned c) = c) by (intros [x y]; reflexivity).
  assert (Ds : forall c k, ds c (flip (B k)) = ds (turned c) (B k))
    by (intros c k; rewrite <- (T c) at 1; apply flipped_distances).
  assert (Dl : forall c k, dl c (flip (B k)) = dl (turned c) (B k))
    by (intros c k; rewrite <- (T c) at 1; apply flipped_distances).
  assert (Hi : forall u k, dot u (highest u (flip (B k))) = dot (turned u) (highest (turned u) (B k)))
    by (intros u k; rewrite <- (T u) at 1 2; apply flipped_heights).
  assert (Lo : forall u k, dot u (lowest u (flip (B k))) = dot (turned u) (lowest (turned u) (B k)))
    by (intros u k; rewrite <- (T u) at 1 2; apply flipped_heights).
  unfold possible, others_allow, possible_far. split; (intros [[c H] | [u [U H]]];
    [left; exists (turned c); intros k K X Y; specialize (H k K X Y); rewrite ?Ds, ?Dl, ?T in *; exact H |
     right; exists (turned u); split; [intros E; apply U; rewrite <- (T u), E; reflexivity |];
     intros a k A S K; specialize (H a k A S K); rewrite ?Hi, ?Lo, ?T in *; exact H]).
Qed.

Theorem possible_either_way N B i j : possible N B i j <-> possible N B j i.
Proof.
  assert (H : forall i j, possible N B i j -> possible N B j i).
  { clear i j. intros i j [[c H] | [u [U H]]]; [left; exists c | right; exists u; split; [exact U |]].
    - intros k K X Y. specialize (H k K Y X). tauto.
    - intros a k A S K. apply H; [exact A | unfold pair in *; tauto | exact K]. }
  split; apply H.
Qed.

(* A chain [COV-2]: the first blocks the one end, the last the other end, the part that each blocks is connected, and
   each two neighbours block a common place. Then the pair is not possible. *)
Theorem chain_refutes N B i j (g : R -> R) (k : nat -> nat) n : (i < N)%nat -> (j < N)%nat -> xhi (B i) < xlo (B j) ->
  (forall x t, ds (x, t) (B i) = ds (x, t) (B j) <-> x = g t) -> (forall m, (m <= n)%nat -> (k m < N)%nat) ->
  blocks_end (B i) (end_down (B i) (B j)) (B (k 0%nat)) -> blocks_end (B i) (end_up (B i) (B j)) (B (k n)) ->
  (forall m, (m <= n)%nat -> interval (fun t => blocks (g t, t) (B i) (B (k m)))) ->
  (forall m, (m < n)%nat -> exists t, blocks (g t, t) (B i) (B (k m)) /\ blocks (g t, t) (B i) (B (k (S m)))) ->
  ~ possible N B i j.
Proof.
  intros I J Ap Curve Ks Low High Parts Meet P. apply (tangents_suffice N B i j I J) in P.
  destruct P as [[c [E Free]] | P].
  - destruct c as [x t]. apply Curve in E. subst x.
    destruct (blocks_near_down (B i) (B j) Ap g Curve _ Low) as [a Ha].
    destruct (blocks_near_up (B i) (B j) Ap g Curve _ High) as [b Hb].
    destruct (chain_covers (fun m s => blocks (g s, s) (B i) (B (k m))) n Parts Meet (Rmin a t) (Rmax b t) t)
      as (m & M & Bl).
    + specialize (Ha (Rmin a t) (Rmin_l a t)). unfold blocks. lra.
    + specialize (Hb (Rmax b t) (Rmax_l b t)). unfold blocks. lra.
    + left. split; [apply Rmin_r | apply Rmax_r].
    + assert (Et : ds (g t, t) (B i) = ds (g t, t) (B j)) by now apply Curve.
      apply (Free (k m)); [now apply Ks | | | exact Bl]; intros X; rewrite X in Bl; unfold blocks in Bl.
      * pose proof (ds_le_dl (g t, t) (B i)). lra.
      * pose proof (ds_le_dl (g t, t) (B j)). lra.
  - apply (ends_exact N B i j I J Ap) in P. destruct P as [P | P].
    + apply (P (k 0%nat)); [apply Ks; lia | exact Low].
    + apply (P (k n)); [now apply Ks | exact High].
Qed.

(* Where a site stops to block is a critical circle [CRIT-1]: of positive radius, and of three disjoint rectangles. *)
Theorem stop_is_circle Y Z K (g : R -> R) t : xhi Y < xlo Z -> (forall x t, ds (x, t) Y = ds (x, t) Z <-> x = g t) ->
  stops (fun s => ds (g s, s) Y - dl (g s, s) K) t ->
  0 < ds (g t, t) Y /\ ds (g t, t) Z = ds (g t, t) Y /\ dl (g t, t) K = ds (g t, t) Y /\
  forall z, inside z K -> ~ inside z Y /\ ~ inside z Z.
Proof.
  intros Ap Curve [E (a & L & Bl)].
  assert (Same : forall s, ds (g s, s) Y = ds (g s, s) Z) by (intros s; now apply Curve).
  assert (Off : forall z, inside z K -> ~ inside z Y /\ ~ inside z Z).
  { intros z Iz. specialize (Bl a ltac:(lra)). specialize (Same a). pose proof (le_dl (g a, a) K z Iz).
    split; intros X; pose proof (ds_le (g a, a) _ z X); lra. }
  split; [| split; [now symmetry | split; [lra | exact Off]]].
  destruct (Rle_lt_or_eq_dec 0 _ (ds_nonneg (g t, t) Y)) as [P | P]; [exact P | exfalso].
  assert (W : (g t, t) = nearest (g t, t) Y /\ (g t, t) = nearest (g t, t) Z).
  { split; apply dist_zero; [change (ds (g t, t) Y = 0) | change (ds (g t, t) Z = 0)]; [lra | rewrite <- Same; lra]. }
  destruct W as [Wy Wz]. pose proof (nearest_inside (g t, t) Y) as Iy. pose proof (nearest_inside (g t, t) Z) as Iz.
  rewrite <- Wy in Iy. rewrite <- Wz in Iz. destruct Iy as [[_ A] _]. destruct Iz as [[B _] _]. simpl in *. lra.
Qed.
