(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* All points move straight from p to q. While no site comes to an edge of a triangulation, and no corner of the hull
   comes between its neighbours (those on one line with them stay where they are), the triangulation stays as it is. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc TiedFace Crossing Path Fan
  Triangulation ToleranceNear.
Open Scope R_scope.

(* A triangulation of the points p: round each site a its triangles a, i, j, counterclockwise, without a further site in
   them; each side belongs to the next triangle too or to the rim, which goes round the hull counterclockwise. *)
Record skeleton (N : nat) (p : nat -> point) (faces : nat -> list (nat * nat)) (rim edge : nat -> nat -> Prop) : Prop := {
  some_face : forall a, (a < N)%nat -> faces a <> nil;
  face_sites : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> (i < N)%nat /\ (j < N)%nat /\ i <> a /\ j <> a /\ i <> j;
  face_edges : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> edge a i /\ edge a j /\ edge i j;
  face_left : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> 0 < orient (p a) (p i) (p j);
  face_empty : forall a i j m, (a < N)%nat -> In (i, j) (faces a) -> (m < N)%nat -> m <> a -> m <> i -> m <> j ->
    ~ (0 <= orient (p a) (p i) (p m) /\ 0 <= orient (p a) (p m) (p j) /\ 0 <= orient (p i) (p j) (p m));
  face_before : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> (exists l, In (l, i) (faces a)) \/ rim a i;
  face_after : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> (exists l, In (j, l) (faces a)) \/ rim j a;
  rim_sites : forall u v, rim u v -> (u < N)%nat /\ (v < N)%nat /\ u <> v /\ edge u v;
  rim_goes_on : forall u v, rim u v -> (exists w, rim v w) /\ (exists t, rim t u);
  rim_turns : forall u v w, rim u v -> rim v w -> u <> w;
  rim_left : forall u v k, rim u v -> (k < N)%nat -> 0 <= orient (p u) (p v) (p k) }.

Lemma nonzero_stays f t : continuity f -> 0 < f 0 -> (forall s, 0 <= s <= 1 -> f s <> 0) -> 0 <= t <= 1 -> 0 < f t.
Proof.
  intros C F H T. apply Rnot_le_lt. intros Y.
  destruct (intermediate (fun s => - f (t * s))) as [s [S E]].
  - apply (continuity_opp (fun s => f (t * s))), (continuity_comp (fun s => t * s) f); [reg | exact C].
  - rewrite Rmult_0_r. lra.
  - rewrite Rmult_1_r. lra.
  - apply (H (t * s)); [nra | lra].
Qed.

(* A point of a closed triangle that is on the line of a side is on the side. *)
Lemma on_side a i j m : 0 < orient a i j -> orient a i m = 0 -> 0 <= orient a m j -> 0 <= orient i j m -> between m a i.
Proof.
  intros D Z A B. pose proof (bary_sum a i j m) as S. pose proof (bary_x a i j m) as X. pose proof (bary_y a i j m) as Y.
  set (d := orient a i j) in *. set (k := orient a m j / d).
  assert (I : orient a m j = k * d) by (unfold k; field; lra).
  assert (O : orient i j m = d - k * d) by lra. rewrite I in A. rewrite O in B.
  exists k. split; [split; nra |]. apply (scaled_point_eq d); [lra | |].
  - rewrite X, Z, I, O. unfold mix. simpl. ring.
  - rewrite Y, Z, I, O. unfold mix. simpl. ring.
Qed.

(* Beyond v on the line from u, a point is on the wrong side of the way on from v. *)
Lemma beyond_turn u v w k s : v = mix s u k -> s * orient v w k = - (1 - s) * orient u v w.
Proof. intros ->. unfold orient, mix. simpl. ring. Qed.

(* Of two points beyond which v lies from k, one is between v and the other. *)
Lemma same_side v k u w : v <> k -> between v u k -> between v w k -> between u v w \/ between w v u.
Proof.
  assert (Ray : forall u, v <> k -> between v u k -> exists l, 0 <= l /\
    fst u = fst v + l * (fst v - fst k) /\ snd u = snd v + l * (snd v - snd k)).
  { intros z D [s [S E]]. assert (S1 : s <> 1) by (intros ->; rewrite mix_1 in E; contradiction).
    assert (I : 0 < / (1 - s)) by (apply Rinv_0_lt_compat; lra). exists (s / (1 - s)). split; [apply Rmult_le_pos; lra |].
    pose proof (f_equal fst E) as X. pose proof (f_equal snd E) as Y. unfold mix in X, Y. simpl in X, Y.
    split; apply (Rmult_eq_reg_l (1 - s)); try lra; rewrite Rmult_plus_distr_l;
      replace ((1 - s) * (s / (1 - s) * (fst v - fst k))) with (s * (fst v - fst k)) by (field; lra);
      replace ((1 - s) * (s / (1 - s) * (snd v - snd k))) with (s * (snd v - snd k)) by (field; lra); lra. }
  assert (Go : forall l m u w, 0 <= l <= m ->
    fst u = fst v + l * (fst v - fst k) /\ snd u = snd v + l * (snd v - snd k) ->
    fst w = fst v + m * (fst v - fst k) /\ snd w = snd v + m * (snd v - snd k) -> between u v w).
  { clear. intros l m u w L [Ux Uy] [Wx Wy]. destruct (Req_dec m 0) as [Z | Z].
    - exists 0. split; [lra |]. rewrite mix_0. rewrite (surjective_pairing u), (surjective_pairing v). simpl.
      replace l with 0 in * by lra. f_equal; lra.
    - assert (0 < / m) by (apply Rinv_0_lt_compat; lra). exists (l / m). split.
      + split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r m); [lra |]. unfold Rdiv.
        rewrite Rmult_assoc, Rinv_l by lra. lra.
      + rewrite (surjective_pairing u). unfold mix. rewrite Ux, Uy, Wx, Wy. f_equal; field; exact Z. }
  intros D U W. destruct (Ray u D U) as [l [L Hu]]. destruct (Ray w D W) as [m [M Hw]].
  destruct (Rle_dec l m); [left; apply (Go l m) | right; apply (Go m l)]; auto; lra.
Qed.

(* Along a line of the hull: steps u v from corner to corner, all on one side (sg is 1 or -1: both ways round). Where
   three consecutive corners turn strictly or are flat, each site on the line of a side is reached by flat corners. *)
Section Chain.
Variables (N : nat) (z : nat -> point) (step : nat -> nat -> Prop) (sg : R) (flat : nat -> nat -> nat -> Prop).
Variable sites : forall u v, step u v -> (u < N)%nat /\ (v < N)%nat /\ u <> v.
Variable free : forall u v k, step u v -> (k < N)%nat -> k <> u -> k <> v -> ~ between (z k) (z u) (z v).
Variable left : forall u v k, step u v -> (k < N)%nat -> 0 <= sg * orient (z u) (z v) (z k).
Variable turns : forall u v, step u v -> exists w, step v w /\ u <> w /\
  (flat u v w \/ 0 < sg * orient (z u) (z v) (z w)).

Definition beyond (u v k : nat) : Prop := step u v /\ (k < N)%nat /\ k <> u /\ k <> v /\ between (z v) (z u) (z k).

Lemma beyond_apart u v k : beyond u v k -> z v <> z k.
Proof.
  intros [S [K [Du [Dv _]]]] E. apply (free u v k S K Du Dv). exists 1. split; [lra |]. now rewrite mix_1.
Qed.

Lemma next_is_flat u v k : beyond u v k -> exists w, step v w /\ u <> w /\ flat u v w.
Proof.
  intros H. pose proof (beyond_apart u v k H) as Ne. destruct H as [S [K [Du [Dv [s [S01 E]]]]]].
  destruct (turns u v S) as [w [S' [Duw [Fl | P]]]]; [now exists w | exfalso].
  assert (S1 : s <> 1) by (intros ->; rewrite mix_1 in E; contradiction).
  pose proof (beyond_turn _ _ (z w) _ s E) as B. pose proof (left v w k S' K) as Y.
  assert (0 < (1 - s) * (sg * orient (z u) (z v) (z w))) by (apply Rmult_lt_0_compat; lra).
  assert (0 <= s * (sg * orient (z v) (z w) (z k))) by (apply Rmult_le_pos; lra).
  assert (s * (sg * orient (z v) (z w) (z k)) = - ((1 - s) * (sg * orient (z u) (z v) (z w)))); [| lra].
  transitivity (sg * (s * orient (z v) (z w) (z k))); [ring | rewrite B; ring].
Qed.

Lemma chain_ends u v k : beyond u v k -> (forall u v w, flat u v w -> orient (z u) (z v) (z w) = 0) ->
  exists u' v', step u' v' /\ flat u' v' k.
Proof.
  intros H Line. destruct (finite_min (fun v => exists u, beyond u v k) (fun v => dist (z v) (z k)) N) as [m [M [[l B] Least]]].
  { exists v. split; [now apply (sites u v), H | now exists u]. }
  clear u v H. pose proof (beyond_apart l m k B) as Ne. destruct (next_is_flat l m k B) as [w [S' [Dlw Fl]]].
  pose proof B as [S [K [Dl [Dm Bt]]]]. destruct (sites l m S) as [L [_ Dlm]]. destruct (sites m w S') as [_ [W Dmw]].
  destruct (Nat.eq_dec k w) as [-> | Dw]; [now exists l, m | exfalso].
  pose proof (free l m w S W (not_eq_sym Dlw) (not_eq_sym Dmw)) as F1.
  pose proof (free m w l S' L Dlm Dlw) as F2.
  assert (Zw : orient (z m) (z w) (z k) = 0).
  { destruct Bt as [s [S01 E]]. pose proof (beyond_turn _ _ (z w) _ s E) as X. rewrite (Line _ _ _ Fl), Rmult_0_r in X.
    apply Rmult_integral in X as [-> | X]; [exfalso | exact X]. rewrite mix_0 in E. apply F2. exists 0.
    split; [lra |]. now rewrite mix_0. }
  destruct (one_between _ _ _ Zw) as [X | [X | X]].
  - destruct (same_side (z m) (z k) (z l) (z w) Ne Bt X) as [Y | Y]; [now apply F2 | apply F1].
    destruct Y as [s [S01 Y]]. exists (1 - s). split; [lra |]. rewrite Y. apply mix_swap.
  - assert (P : beyond m w k) by (now repeat split).
    pose proof (Least w W (ex_intro _ m P)) as Y. destruct X as [s [S01 E]].
    assert (s <> 0). { intros ->. rewrite mix_0 in E. apply F1. exists 1. split; [lra |]. now rewrite mix_1. }
    rewrite E, dist_mix_right in Y by lra. pose proof (dist_pos _ _ Ne). nra.
  - now apply (free m w k S' K Dm Dw).
Qed.
End Chain.

Definition at_point (z : point) : rect := Rect (fst z) (fst z) (snd z) (snd z) (Rle_refl _) (Rle_refl _).

Lemma at_point_exact z : exact (at_point z) z.
Proof.
  split; [unfold inside; simpl; lra |]. intros w [X Y]. simpl in X, Y.
  rewrite (surjective_pairing w), (surjective_pairing z). f_equal; lra.
Qed.

Lemma at_points_choice N q : choice N (fun k => at_point (q k)) q.
Proof. intros k _. apply at_point_exact. Qed.

Section Move.
Variables (N : nat) (p q : nat -> point) (faces : nat -> list (nat * nat)) (rim edge : nat -> nat -> Prop).
Variable sk : skeleton N p faces rim edge.
Let x (t : R) (k : nat) : point := path p q t k.

(* Three points on one line of the hull, which stay where they are. *)
Definition flat (u v w : nat) : Prop := orient (p u) (p v) (p w) = 0 /\ p u = q u /\ p v = q v /\ p w = q w.

Variable edges_free : forall t i j k, 0 <= t <= 1 -> edge i j -> (k < N)%nat -> k <> i -> k <> j ->
  ~ between (x t k) (x t i) (x t j).
Variable corners_stay : forall u v w, rim u v -> rim v w -> flat u v w \/
  forall t, 0 <= t <= 1 -> ~ between (x t v) (x t u) (x t w).

Lemma at_0 k : x 0 k = p k.
Proof. apply mix_0. Qed.

Lemma at_1 k : x 1 k = q k.
Proof. apply mix_1. Qed.

Lemma stays_at t k : p k = q k -> x t k = p k.
Proof. intros E. unfold x, path. rewrite <- E. unfold mix. destruct (p k). simpl. f_equal; ring. Qed.

Lemma flat_at t u v w : flat u v w -> orient (x t u) (x t v) (x t w) = 0.
Proof. intros [Z [U [V W]]]. now rewrite !stays_at. Qed.

Lemma turn_continuous i j k : continuity (fun t => orient (x t i) (x t j) (x t k)).
Proof. unfold x. apply path_orient_continuous. Qed.

Lemma faces_left t a i j : 0 <= t <= 1 -> (a < N)%nat -> In (i, j) (faces a) -> 0 < orient (x t a) (x t i) (x t j).
Proof.
  intros T A F. destruct (face_sites _ _ _ _ _ sk a i j A F) as [I [J [Dia [Dja Dij]]]].
  destruct (face_edges _ _ _ _ _ sk a i j A F) as [Ei [Ej Eij]].
  apply (nonzero_stays (fun t => orient (x t a) (x t i) (x t j))); [apply turn_continuous | | | exact T].
  - rewrite !at_0. now apply (face_left _ _ _ _ _ sk).
  - intros s S Z. destruct (one_between _ _ _ Z) as [X | [X | X]]; revert X; apply edges_free; auto.
Qed.

Lemma corners_left t u v w : 0 <= t <= 1 -> rim u v -> rim v w ->
  flat u v w \/ 0 < orient (x t u) (x t v) (x t w).
Proof.
  intros T Ruv Rvw. destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V [Duv Euv]]].
  destruct (rim_sites _ _ _ _ _ sk v w Rvw) as [_ [W [Dvw Evw]]]. pose proof (rim_turns _ _ _ _ _ sk u v w Ruv Rvw) as Duw.
  destruct (corners_stay u v w Ruv Rvw) as [Fl | Free]; [now left | right].
  assert (Nz : forall s, 0 <= s <= 1 -> orient (x s u) (x s v) (x s w) <> 0).
  { intros s S Z. destruct (one_between _ _ _ Z) as [X | [X | X]]; revert X.
    - now apply edges_free.
    - now apply Free.
    - apply edges_free; auto. }
  apply (nonzero_stays (fun t => orient (x t u) (x t v) (x t w))); [apply turn_continuous | | exact Nz | exact T].
  pose proof (rim_left _ _ _ _ _ sk u v w Ruv W) as L. pose proof (Nz 0 ltac:(lra)) as Z. rewrite !at_0 in *. lra.
Qed.

(* The rim stays convex: where all are on one side of its sides, they are strictly, but for those of flat corners. *)
Definition rim_weak (t : R) : Prop := forall u v k, rim u v -> (k < N)%nat -> 0 <= orient (x t u) (x t v) (x t k).
Definition rim_strict (t : R) : Prop := forall u v k, rim u v -> (k < N)%nat -> k <> u -> k <> v ->
  0 < orient (x t u) (x t v) (x t k) \/ flat u v k.

Lemma beyond_is_flat t u v k : 0 <= t <= 1 -> rim_weak t -> beyond N (x t) rim u v k -> flat u v k.
Proof.
  intros T W H.
  assert (Sites : forall u v, rim u v -> (u < N)%nat /\ (v < N)%nat /\ u <> v)
    by (intros a b R; destruct (rim_sites _ _ _ _ _ sk a b R) as [A [B [D _]]]; auto).
  assert (Free : forall u v k, rim u v -> (k < N)%nat -> k <> u -> k <> v -> ~ between (x t k) (x t u) (x t v))
    by (intros a b c R; apply edges_free; [exact T | now apply (rim_sites _ _ _ _ _ sk)]).
  assert (Left : forall u v k, rim u v -> (k < N)%nat -> 0 <= 1 * orient (x t u) (x t v) (x t k))
    by (intros a b c R C; rewrite Rmult_1_l; now apply W).
  assert (Turns : forall u v, rim u v -> exists w, rim v w /\ u <> w /\ (flat u v w \/ 0 < 1 * orient (x t u) (x t v) (x t w))).
  { intros a b R. destruct (rim_goes_on _ _ _ _ _ sk a b R) as [[c Rc] _]. exists c. split; [exact Rc |].
    split; [now apply (rim_turns _ _ _ _ _ sk a b c) | rewrite Rmult_1_l; now apply corners_left]. }
  destruct (next_is_flat N (x t) rim 1 flat Free Left Turns u v k H) as [w [_ [_ [_ [U [V _]]]]]].
  destruct (chain_ends N (x t) rim 1 flat Sites Free Left Turns u v k H (flat_at t)) as [u' [v' [_ [_ [_ [_ K]]]]]].
  destruct H as [_ [_ [_ [_ [s [S E]]]]]]. rewrite !stays_at in E by assumption.
  split; [| now repeat split]. rewrite E. unfold orient, mix. simpl. ring.
Qed.

Lemma before_is_flat t u v k : 0 <= t <= 1 -> rim_weak t -> beyond N (x t) (fun v u => rim u v) v u k -> flat u v k.
Proof.
  intros T W H. set (step v u := rim u v) in *.
  assert (Sites : forall u v, step u v -> (u < N)%nat /\ (v < N)%nat /\ u <> v)
    by (intros a b R; destruct (rim_sites _ _ _ _ _ sk b a R) as [A [B [D _]]]; auto).
  assert (Free : forall u v k, step u v -> (k < N)%nat -> k <> u -> k <> v -> ~ between (x t k) (x t u) (x t v)).
  { intros a b c R C Da Db [s [S E]]. apply (edges_free t b a c T); auto; [now apply (rim_sites _ _ _ _ _ sk) |].
    exists (1 - s). split; [lra |]. rewrite E. apply mix_swap. }
  assert (Left : forall u v k, step u v -> (k < N)%nat -> 0 <= -1 * orient (x t u) (x t v) (x t k)).
  { intros a b c R C. pose proof (W b a c R C). unfold orient in *. lra. }
  assert (Turns : forall u v, step u v -> exists w, step v w /\ u <> w /\ (flat w v u \/ 0 < -1 * orient (x t u) (x t v) (x t w))).
  { intros a b R. destruct (rim_goes_on _ _ _ _ _ sk b a R) as [_ [c Rc]]. exists c. split; [exact Rc |].
    split; [apply not_eq_sym; now apply (rim_turns _ _ _ _ _ sk c b a) |].
    destruct (corners_left t c b a T Rc R) as [X | X]; [now left | right]. unfold orient in *. lra. }
  destruct (next_is_flat N (x t) step (-1) (fun u v w => flat w v u) Free Left Turns v u k H) as [w [_ [_ [_ [_ [U V]]]]]].
  destruct (chain_ends N (x t) step (-1) (fun u v w => flat w v u) Sites Free Left Turns v u k H) as [u' [v' [_ [_ [K _]]]]].
  { intros a b c Fl. pose proof (flat_at t _ _ _ Fl). unfold orient in *. lra. }
  destruct H as [_ [_ [_ [_ [s [S E]]]]]]. rewrite !stays_at in E by assumption.
  split; [| now repeat split]. rewrite E. unfold orient, mix. simpl. ring.
Qed.

Lemma rim_strictly t : 0 <= t <= 1 -> rim_weak t -> rim_strict t.
Proof.
  intros T W u v k Ruv K Du Dv. destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V [Duv Euv]]].
  destruct (Rle_lt_or_eq_dec _ _ (W u v k Ruv K)) as [L | Z]; [now left | right]. symmetry in Z.
  destruct (one_between _ _ _ Z) as [X | [X | X]].
  - apply (before_is_flat t u v k T W). repeat split; auto.
  - apply (beyond_is_flat t u v k T W). now repeat split.
  - now elim (edges_free t u v k T Euv K Du Dv).
Qed.

Lemma rim_strict_weak t : rim_strict t -> rim_weak t.
Proof.
  intros H u v k R K. destruct (Nat.eq_dec k u) as [-> | Du]; [unfold orient; lra |].
  destruct (Nat.eq_dec k v) as [-> | Dv]; [unfold orient; lra |].
  destruct (H u v k R K Du Dv) as [L | Fl]; [now left | right]. symmetry. now apply flat_at.
Qed.

Lemma rim_at_first : rim_strict 0.
Proof. apply rim_strictly; [lra |]. intros u v k R K. rewrite !at_0. now apply (rim_left _ _ _ _ _ sk). Qed.

Lemma rim_stays : rim_strict 1.
Proof.
  apply open_closed; [apply rim_at_first | |].
  - intros t T H.
    assert (X : near t (fun s => forall u, (u < N)%nat -> forall v, (v < N)%nat -> forall k, (k < N)%nat ->
      rim u v -> k <> u -> k <> v -> 0 < orient (x s u) (x s v) (x s k) \/ flat u v k)).
    { apply all_near. intros u U. apply all_near. intros v V. apply all_near. intros k K.
      destruct (classic (rim u v /\ k <> u /\ k <> v)) as [[R [Du Dv]] | D].
      - destruct (H u v k R K Du Dv) as [P | Fl].
        + pose proof (near_positive _ t (turn_continuous u v k) P) as Y. revert Y. apply near_weaken. now left.
        + exists 1. split; [lra |]. now right.
      - exists 1. split; [lra |]. intros s _ R Du Dv. now elim D. }
    destruct X as [e [E G]]. exists e. split; [exact E |]. intros s S _ u v k R K.
    destruct (rim_sites _ _ _ _ _ sk u v R) as [U [V _]]. now apply (G s S u U v V k K).
  - intros t T H.
    assert (X : exists u v k, rim u v /\ (k < N)%nat /\ orient (x t u) (x t v) (x t k) < 0).
    { apply NNPP. intros Ne. apply H, rim_strictly; [exact T |]. intros u v k R K. apply Rnot_lt_le. intros L.
      apply Ne. now exists u, v, k. }
    destruct X as [u [v [k [R [K L]]]]].
    destruct (near_negative _ t (turn_continuous u v k) L) as [e [E G]]. exists e. split; [exact E |].
    intros s S _ Y. pose proof (G s S). pose proof (rim_strict_weak s Y u v k R K). lra.
Qed.

(* No site enters a face. *)
Definition in_face (t : R) (a i j m : nat) : Prop :=
  0 <= orient (x t a) (x t i) (x t m) /\ 0 <= orient (x t a) (x t m) (x t j) /\ 0 <= orient (x t i) (x t j) (x t m).

Lemma faces_stay_empty a i j m : (a < N)%nat -> In (i, j) (faces a) -> (m < N)%nat -> m <> a -> m <> i -> m <> j ->
  ~ in_face 1 a i j m.
Proof.
  intros A F M Da Di Dj. destruct (face_sites _ _ _ _ _ sk a i j A F) as [I [J [Dia [Dja Dij]]]].
  destruct (face_edges _ _ _ _ _ sk a i j A F) as [Ei [Ej Eij]].
  apply (open_closed (fun t => ~ in_face t a i j m)).
  - unfold in_face. rewrite !at_0. now apply (face_empty _ _ _ _ _ sk a i j m).
  - intros t T H.
    destruct (Rle_dec 0 (orient (x t a) (x t i) (x t m))) as [O1 | O1];
      [destruct (Rle_dec 0 (orient (x t a) (x t m) (x t j))) as [O2 | O2];
        [destruct (Rle_dec 0 (orient (x t i) (x t j) (x t m))) as [O3 | O3]; [now elim H |] |] |].
    + destruct (near_negative _ t (turn_continuous i j m) (Rnot_le_lt _ _ O3)) as [e [E G]]. exists e. split; [exact E |].
      intros s S _ [_ [_ Y]]. pose proof (G s S). lra.
    + destruct (near_negative _ t (turn_continuous a m j) (Rnot_le_lt _ _ O2)) as [e [E G]]. exists e. split; [exact E |].
      intros s S _ [_ [Y _]]. pose proof (G s S). lra.
    + destruct (near_negative _ t (turn_continuous a i m) (Rnot_le_lt _ _ O1)) as [e [E G]]. exists e. split; [exact E |].
      intros s S _ [Y _]. pose proof (G s S). lra.
  - intros t T H. apply NNPP in H. destruct H as [O1 [O2 O3]]. pose proof (faces_left t a i j T A F) as D.
    assert (P1 : 0 < orient (x t a) (x t i) (x t m)).
    { destruct (Rle_lt_or_eq_dec _ _ O1) as [L | Z]; [exact L | exfalso]. symmetry in Z.
      apply (edges_free t a i m T Ei M Da Di). now apply on_side with (x t j). }
    assert (P3 : 0 < orient (x t i) (x t j) (x t m)).
    { destruct (Rle_lt_or_eq_dec _ _ O3) as [L | Z]; [exact L | exfalso]. symmetry in Z.
      apply (edges_free t i j m T Eij M Di Dj). apply on_side with (x t a); unfold orient in *; lra. }
    assert (P2 : 0 < orient (x t a) (x t m) (x t j)).
    { destruct (Rle_lt_or_eq_dec _ _ O2) as [L | Z]; [exact L | exfalso]. symmetry in Z.
      apply (edges_free t a j m T Ej M Da Dj). destruct (on_side (x t j) (x t a) (x t i) (x t m)) as [s [S E]];
        try (unfold orient in *; lra). exists (1 - s). split; [lra |]. rewrite E. apply mix_swap. }
    pose proof (near_positive _ t (turn_continuous a m j) P2) as Y2.
    pose proof (near_positive _ t (turn_continuous i j m) P3) as Y3.
    destruct (near_and _ _ _ (near_positive _ t (turn_continuous a i m) P1) (near_and _ _ _ Y2 Y3)) as [e [E G]].
    clear Y2 Y3.
    exists e. split; [exact E |]. intros s S _ Ne. apply Ne. destruct (G s S) as [Y1 [Y2 Y3]]. unfold in_face. lra.
Qed.

(* At the end b is not a partner of a, but one of a's faces: where for each of a's faces some circle through the side
   across has neither inside, and one of them outside, and b is on no flat side of the hull at a. *)
Theorem others_are_no_edges a b : (a < N)%nat -> (b < N)%nat -> a <> b ->
  (forall i j, In (i, j) (faces a) -> b <> i /\ b <> j) ->
  (forall i j, In (i, j) (faces a) -> exists o r, dist o (q i) = r /\ dist o (q j) = r /\
    r <= dist o (q a) /\ r <= dist o (q b) /\ (r < dist o (q a) \/ r < dist o (q b))) ->
  (forall u v, rim u v -> a = u \/ a = v -> ~ flat u v b) -> ~ weak_edge N q a b.
Proof.
  intros A B D Nb Round Off.
  assert (Free : forall i j k, edge i j -> (k < N)%nat -> k <> i -> k <> j -> ~ between (q k) (q i) (q j)).
  { intros i j k E K Di Dj. rewrite <- !at_1. apply edges_free; auto. lra. }
  assert (Left : forall i j, In (i, j) (faces a) -> 0 < orient (q a) (q i) (q j)).
  { intros i j F. pose proof (faces_left 1 a i j ltac:(lra) A F) as L. now rewrite !at_1 in L. }
  assert (Side : forall u v m, rim u v -> (m < N)%nat -> 0 <= orient (q u) (q v) (q m)).
  { intros u v m R M. pose proof (rim_strict_weak 1 rim_stays u v m R M) as L. now rewrite !at_1 in L. }
  assert (Fan : fan_round N q a (faces a)).
  { split; [now apply (some_face _ _ _ _ _ sk) |]. intros i j F.
    destruct (face_sites _ _ _ _ _ sk a i j A F) as [I [J _]]. split; [now split |]. split; [now apply Left |]. split.
    - destruct (face_before _ _ _ _ _ sk a i j A F) as [X | R]; [now left | right]. intros m M. now apply Side.
    - destruct (face_after _ _ _ _ _ sk a i j A F) as [X | R]; [now left | right]. intros m M.
      pose proof (Side j a m R M). unfold orient in *. lra. }
  assert (Npq : q b <> q a).
  { destruct (faces a) as [| [i j] rest] eqn:Ef; [now elim (some_face _ _ _ _ _ sk a A) |].
    assert (F : In (i, j) (faces a)) by (rewrite Ef; now left). rewrite <- Ef in *. intros E.
    destruct (face_edges _ _ _ _ _ sk a i j A F) as [Ei _]. destruct (Nb i j F) as [Di _].
    apply (Free a i b Ei B (not_eq_sym D) Di). exists 0. split; [lra |]. now rewrite mix_0. }
  destruct (sites_covered N q a (faces a) Fan b A B Npq) as [i [j [F [O1 O2]]]].
  destruct (face_sites _ _ _ _ _ sk a i j A F) as [I [J [Dia [Dja Dij]]]].
  destruct (face_edges _ _ _ _ _ sk a i j A F) as [Ei [Ej Eij]]. destruct (Nb i j F) as [Di Dj].
  assert (O3 : orient (q i) (q j) (q b) <= 0).
  { apply Rnot_lt_le. intros C. pose proof (faces_stay_empty a i j b A F B (not_eq_sym D) Di Dj) as L. apply L.
    unfold in_face. rewrite !at_1. repeat split; lra. }
  pose proof (Left i j F) as Dg.
  assert (O : orient (q i) (q j) (q b) < 0).
  { destruct O3 as [L | Z]; [exact L | exfalso]. apply (Free i j b Eij B Di Dj). apply on_side with (q a);
      unfold orient in *; lra. }
  apply (leaving_is_no_edge N a b (faces a) A B q i j Left); auto.
  - intros k l K. destruct (face_sites _ _ _ _ _ sk a k l A K) as [X [Y _]]. now split.
  - now split; [| split].
  - intros s t S T Z. destruct (Round i j F) as [o [r [Oi [Oj [Oa [Ob Out]]]]]].
    apply (meeting_chord N q i j a b s t o r); auto.
    assert (R0 : 0 <= r) by (rewrite <- Oi; apply dist_nonneg).
    pose proof (power_ge o r _ R0 Oa) as Pa. pose proof (power_ge o r _ R0 Ob) as Pb.
    assert (T0 : t <> 0).
    { intros ->. rewrite mix_0 in Z. apply (Free i j a Eij A (not_eq_sym Dia) (not_eq_sym Dja)). now exists s. }
    assert (T1 : t <> 1). { intros ->. rewrite mix_1 in Z. apply (Free i j b Eij B Di Dj). now exists s. }
    assert (0 <= (1 - t) * power o r (q a)) by (apply Rmult_le_pos; lra).
    assert (0 <= t * power o r (q b)) by (apply Rmult_le_pos; lra).
    destruct Out as [Out | Out]; pose proof (power_gt o r _ R0 Out).
    + assert (0 < (1 - t) * power o r (q a)) by (apply Rmult_lt_0_compat; lra). lra.
    + assert (0 < t * power o r (q b)) by (apply Rmult_lt_0_compat; lra). lra.
  - destruct (face_before _ _ _ _ _ sk a i j A F) as [X | R]; [now left | right]. intros Z.
    destruct (rim_stays a i b R B (not_eq_sym D) Di) as [L | Fl]; [rewrite !at_1 in L; lra |].
    now apply (Off a i R (or_introl eq_refl)).
  - destruct (face_after _ _ _ _ _ sk a i j A F) as [X | R]; [now left | right]. intros Z.
    destruct (rim_stays j a b R B Dj (not_eq_sym D)) as [L | Fl]; [rewrite !at_1 in L; unfold orient in *; lra |].
    now apply (Off j a R (or_intror eq_refl)).
Qed.
End Move.
